// Two panels of error against CPU time. Each series is a way to solve; a line joins rows that
// differ only in the time step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "reports/bench_pages.hpp"
#include "reports/figures/gnuplot.hpp"

namespace havers::reports {
namespace {

// Less is rounding; it is drawn on the lower edge.
constexpr double smallest_error = 1e-15;

// Point types are gnuplot's of full points; one less is the hollow one.
struct Series {
  std::string_view title, size, colour;
  int point;
  // Null: the series of settings with another mesh than the reference.
  bool (*holds)(const sim::BenchSetting& setting);
};

bool steps_in_time(const sim::BenchSetting& s, sim::ContactMethod method) {
  return s.regime == sim::Regime::dynamic && s.contact == method && s.leave_out;
}

constexpr std::array<Series, 5> all_series{{
    {"active set", "1", "blue", 7,
     [](const auto& s) { return steps_in_time(s, sim::ContactMethod::active_set); }},
    {"nothing left out", "1.1", "orange", 11, [](const auto& s) { return !s.leave_out; }},
    {"Gauss-Seidel", "1.1", "red", 9,
     [](const auto& s) { return steps_in_time(s, sim::ContactMethod::gauss_seidel); }},
    {"quasi-static", "1", "green", 5,
     [](const auto& s) { return s.regime == sim::Regime::quasi_static && s.leave_out; }},
    {"finer mesh", "1.2", "purple", 13, nullptr},
}};

bool belongs(const sim::BenchSetting& setting, const sim::BenchSetting& reference,
             const Series& series) {
  const bool finer = setting.refinement != reference.refinement;
  return series.holds == nullptr ? finer : !finer && series.holds(setting);
}

double drawn(double error) {
  return std::max(error, smallest_error);
}

// CPU time and error, median, least and largest of each.
std::string line_of(const sim::BenchSpread& cpu, const sim::BenchSpread& error) {
  return fmt::format("{:.4g} {:.4g} {:.4g} {:.4g} {:.4g} {:.4g}\n", cpu.median, drawn(error.median),
                     cpu.low, cpu.high, drawn(error.low), drawn(error.high));
}

bool differ_in_step_alone(sim::BenchSetting a, const sim::BenchSetting& b) {
  const bool both_given = a.step && b.step;
  a.step = b.step;
  return both_given && a == b;
}

// One quantity's errors, as commands of gnuplot.
class ErrorPanel {
 public:
  ErrorPanel(const sim::WorkPrecision& study, std::string name,
             sim::BenchSpread sim::BenchErrors::*error)
      : study_(study), name_(std::move(name)), error_(error) {}

  std::string commands() {
    for (const Series& series : all_series) {
      add_lines(series);
      add_points(series);
    }
    // A line at what the reference itself may err by: smaller errors cannot be told.
    if (const double error = (study_.reference_errors.*error_).high; error > 0.0)
      plots_ += fmt::format(", {:.4g} with lines dt 2 lc rgb grey notitle", drawn(error));
    return data_.empty() ? std::string() : data_ + plots_ + "\n";
  }

 private:
  [[nodiscard]] std::vector<const sim::BenchRow*> rows_of(const Series& series) const {
    std::vector<const sim::BenchRow*> rows;
    for (std::size_t i = 1; i < study_.rows.size(); ++i)  // the reference has no error
      if (belongs(study_.rows[i].setting, study_.reference, series) &&
          std::isfinite((study_.rows[i].errors.*error_).median))
        rows.push_back(&study_.rows[i]);
    return rows;
  }

  // Through the steps of one solver, tolerance and mesh; an empty line of the data ends a line.
  void add_lines(const Series& series) {
    std::string lines;
    const sim::BenchRow* before = nullptr;
    for (const sim::BenchRow* row : rows_of(series)) {
      if (before != nullptr && !differ_in_step_alone(row->setting, before->setting)) lines += "\n";
      lines += line_of(row->cpu, row->errors.*error_);
      before = row;
    }
    plot(lines, fmt::format("using 1:2 with lines lw 0.8 lc rgb {} notitle", series.colour));
  }

  // Hollow where not all runs are to be trusted.
  void add_points(const Series& series) {
    std::array<std::string, 2> points;
    for (const sim::BenchRow* row : rows_of(series))
      points.at(row->trusted == row->runs ? 1 : 0) += line_of(row->cpu, row->errors.*error_);
    std::string_view title = series.title;
    for (const int full : {1, 0}) {
      const std::string& data = points.at(static_cast<std::size_t>(full));
      plot(data, fmt::format("using 1:2:3:4:5:6 with xyerrorbars lw 1.2 pt {} ps {} lc rgb {} {}",
                             series.point - 1 + full, series.size, series.colour,
                             title.empty() ? "notitle" : fmt::format("title '{}'", title)));
      // The legend names a series only once, even if it has full and hollow points.
      if (!data.empty()) title = {};
    }
  }

  void plot(const std::string& data, const std::string& how) {
    if (data.empty()) return;
    // Each block before this one has one "$" in data_: their count makes a new name.
    const std::string block = fmt::format("${}{}", name_, std::ranges::count(data_, '$'));
    data_ += fmt::format("{} << EOD\n{}EOD\n", block, data);
    plots_ += fmt::format("{}{} {}", plots_.empty() ? "plot " : ", ", block, how);
  }

  const sim::WorkPrecision& study_;
  std::string name_;
  sim::BenchSpread sim::BenchErrors::*error_;
  std::string data_, plots_;
};

}  // namespace

std::string work_precision_svg(const sim::WorkPrecision& study) {
  Figure figure{.id = "work",
                .description = "Error against CPU time of every setting, logarithmic on both axes",
                .height = 720};
  const std::string forces =
      ErrorPanel(study, "forces", &sim::BenchErrors::bonded_forces).commands();
  const std::string strain =
      ErrorPanel(study, "strain", &sim::BenchErrors::failure_strain).commands();
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
