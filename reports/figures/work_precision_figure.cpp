#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/bench_pages.hpp"
#include "reports/figures/gnuplot.hpp"

namespace havers::reports {
namespace {

// Less is rounding; it is drawn on the lower edge.
constexpr double smallest_error = 1e-15;

// Point types are gnuplot's of full points; one less is the hollow one.
struct Series {
  std::string_view title, look;
  int point;
  bool (*holds)(const sim::BenchSetting& setting);
};

bool steps_in_time(const sim::BenchSetting& s, sim::ContactMethod method) {
  return s.regime == sim::Regime::dynamic && s.contact == method && s.leave_out;
}

constexpr std::array<Series, 5> all_series{{
    {"active set", "ps 1 lc rgb blue", 7,
     [](const auto& s) { return steps_in_time(s, sim::ContactMethod::active_set); }},
    {"nothing left out", "ps 1.1 lc rgb orange", 11, [](const auto& s) { return !s.leave_out; }},
    {"Gauss-Seidel", "ps 1.1 lc rgb red", 9,
     [](const auto& s) { return steps_in_time(s, sim::ContactMethod::gauss_seidel); }},
    {"quasi-static", "ps 1 lc rgb green", 5,
     [](const auto& s) { return s.regime == sim::Regime::quasi_static && s.leave_out; }},
    {"finer mesh", "ps 1.2 lc rgb purple", 13, nullptr},
}};

bool belongs(const sim::BenchSetting& setting, const sim::BenchSetting& reference,
             const Series& series) {
  const bool finer = setting.refinement != reference.refinement;
  return series.holds == nullptr ? finer : !finer && series.holds(setting);
}

double drawn(double error) {
  return std::max(error, smallest_error);
}

// CPU time and error, median, least and largest of each; nothing where the error is not known.
std::string line_of(const sim::BenchSpread& cpu, const sim::BenchSpread& error) {
  if (!std::isfinite(error.median)) return {};
  return fmt::format("{:.4g} {:.4g} {:.4g} {:.4g} {:.4g} {:.4g}\n", cpu.median, drawn(error.median),
                     cpu.low, cpu.high, drawn(error.low), drawn(error.high));
}

std::string work_panel(const sim::WorkPrecision& study, const std::string& name,
                       sim::BenchSpread sim::BenchErrors::*error) {
  std::string data, plots;
  for (const Series& series : all_series) {
    std::array<std::string, 2> lines;                      // not all runs to be trusted; all
    for (std::size_t i = 1; i < study.rows.size(); ++i) {  // the reference has no error
      const sim::BenchRow& row = study.rows[i];
      if (belongs(row.setting, study.reference, series))
        lines.at(row.trusted == row.runs ? 1 : 0) += line_of(row.cpu, row.errors.*error);
    }
    std::string_view title = series.title;
    for (const int full : {1, 0}) {
      const std::string& points = lines.at(static_cast<std::size_t>(full));
      if (points.empty()) continue;
      const std::string block = fmt::format("${}{}", name, std::ranges::count(data, '$'));
      data += fmt::format("{} << EOD\n{}EOD\n", block, points);
      plots +=
          fmt::format("{}{} using 1:2:3:4:5:6 with xyerrorbars lw 1.2 pt {} {} {}",
                      plots.empty() ? "plot " : ", ", block, series.point - 1 + full, series.look,
                      title.empty() ? "notitle" : fmt::format("title '{}'", title));
      title = {};
    }
  }
  return plots.empty() ? std::string() : data + plots + "\n";
}

}  // namespace

std::string work_precision_svg(const sim::WorkPrecision& study) {
  Figure figure{.id = "work",
                .description = "Error against CPU time of every setting, logarithmic on both axes",
                .height = 720};
  const std::string forces = work_panel(study, "forces", &sim::BenchErrors::bonded_forces);
  const std::string strain = work_panel(study, "strain", &sim::BenchErrors::failure_strain);
  if (strain.empty()) return draw(figure);
  figure.commands =
      "set multiplot\nset logscale xy\nset format y '10^{%L}'\nset format x '%g'\n"
      "set offsets graph 0.06,graph 0.06,graph 0.06,graph 0.06\n";
  // Where joints are missing from the start there are no forces of the intact specimen.
  if (!forces.empty())
    figure.commands += panel(0.55, 0.915) +
                       "set ylabel 'Relative error of joint forces' offset 0.8,0\n" + forces +
                       "unset key\n";
  figure.commands += panel(0.09, forces.empty() ? 0.915 : 0.47) +
                     "set xlabel 'CPU time of a run (s)' offset 0,0.5\n"
                     "set ylabel 'Relative error of failure strain' offset 0.8,0\n" +
                     strain + "unset multiplot\n";
  return draw(figure);
}

}  // namespace havers::reports
