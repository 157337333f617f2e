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

struct Series {
  std::string_view title, style;
  bool (*holds)(const sim::BenchSetting& setting, const sim::BenchSetting& reference);
};

bool steps_in_time(const sim::BenchSetting& s, sim::ContactMethod method) {
  return s.regime == sim::Regime::dynamic && s.contact == method;
}

constexpr std::array<Series, 4> all_series{{
    {"active set", "pt 7 ps 1 lc rgb blue",
     [](const auto& s, const auto& r) {
       return steps_in_time(s, sim::ContactMethod::active_set) && s.refinement == r.refinement;
     }},
    {"Gauss-Seidel", "pt 9 ps 1.1 lc rgb red",
     [](const auto& s, const auto&) { return steps_in_time(s, sim::ContactMethod::gauss_seidel); }},
    {"quasi-static", "pt 5 ps 1 lc rgb green",
     [](const auto& s, const auto& r) {
       return s.regime == sim::Regime::quasi_static && s.refinement == r.refinement;
     }},
    {"finer mesh", "pt 12 ps 1.2 lc rgb purple",
     [](const auto& s, const auto& r) { return s.refinement != r.refinement; }},
}};

double drawn(double error) {
  return std::max(error, smallest_error);
}

// Rows of one series: CPU time and error, median, least and largest of each. The reference is left
// out: its error is 0 by definition.
std::string series_data(const sim::WorkPrecision& study, const Series& series,
                        sim::BenchSpread sim::BenchErrors::*error) {
  std::string lines;
  for (std::size_t i = 1; i < study.rows.size(); ++i) {
    const sim::BenchRow& row = study.rows[i];
    const sim::BenchSpread& e = row.errors.*error;
    if (!series.holds(row.setting, study.reference) || !std::isfinite(e.median)) continue;
    lines += fmt::format("{:.4g} {:.4g} {:.4g} {:.4g} {:.4g} {:.4g}\n", row.cpu.median,
                         drawn(e.median), row.cpu.low, row.cpu.high, drawn(e.low), drawn(e.high));
  }
  return lines;
}

std::string work_panel(const sim::WorkPrecision& study, const std::string& name,
                       sim::BenchSpread sim::BenchErrors::*error) {
  std::string data, plots;
  for (std::size_t i = 0; i < all_series.size(); ++i) {
    const std::string lines = series_data(study, all_series.at(i), error);
    if (lines.empty()) continue;
    data += fmt::format("${}{} << EOD\n{}EOD\n", name, i, lines);
    plots += fmt::format("{}${}{} using 1:2:3:4:5:6 with xyerrorbars lw 1.2 {} title '{}'",
                         plots.empty() ? "plot " : ", ", name, i, all_series.at(i).style,
                         all_series.at(i).title);
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
  if (!forces.empty() && !strain.empty())
    figure.commands =
        "set multiplot\nset logscale xy\nset format y '10^{%L}'\nset offsets graph 0.06,graph "
        "0.06,graph 0.06,graph 0.06\n" +
        panel(0.56, 0.95) + "set ylabel 'Error of joint forces' offset 1.5,0\n" + forces +
        panel(0.09, 0.48) +
        "set xlabel 'CPU time of a run (s)' offset 0,0.5\n"
        "set ylabel 'Error of the failure strain' offset 1.5,0\nunset key\n" +
        strain + "unset multiplot\n";
  return draw(figure);
}

}  // namespace havers::reports
