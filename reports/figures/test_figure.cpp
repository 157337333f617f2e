// A test on stress-strain axes: as read, and drawn over that, as used. If it cannot be reduced, its
// record is shown.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "reports/figures/figures.hpp"
#include "reports/figures/thin.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

constexpr std::string_view test_commands = R"gnuplot(
set xlabel 'Strain (%)' offset 0,0.5
set ylabel 'Engineering stress (MPa)'
set yrange [{lowest}:{highest}]
set object 1 rectangle from first {low},graph 0 to first {high},graph 1 fc rgb '#f4efe2' fs solid noborder behind
plot $raw using ($1*100):($2*1e-6) with lines lw 3.2 lc rgb '#c4c4c4' title '{as_read}', {after_break}\
  $used using ($1*100):($2*1e-6) with lines lw 1.4 lc rgb blue title 'as used', \
  $line using ($1*100):($2*1e-6) with lines lw 2.2 lc rgb orange title 'modulus; window shaded', \
  $peak using ($1*100):($2*1e-6) with points pt 12 ps 1.3 lw 1.6 lc rgb red title 'strength'
)gnuplot";

// The parted specimen draws no line back through the loading.
constexpr std::string_view after_break_plot =
    "$rest using ($1*100):($2*1e-6) with points pt 7 ps 0.25 lc rgb '#a8a8a8' "
    "title 'read after the break', ";

constexpr std::string_view time_commands = R"gnuplot(
unset object 1
unset key
set xlabel 'Time (s)' offset 0,0.5
set ylabel 'Time step (s)'
set yrange [0:*]
plot $raw_steps using 1:2 with points pt 7 ps 0.45 lc rgb '#b0b0b0', \
  $used_steps using 1:2 with points pt 7 ps 0.25 lc rgb blue
unset multiplot
)gnuplot";

// Time steps from row to row, over time. [s, s]
Points steps_of(const std::vector<double>& time) {
  Points steps;
  for (std::size_t i = 1; i < time.size(); ++i) {
    steps.x.push_back(time[i]);
    steps.y.push_back(time[i] - time[i - 1]);
  }
  return thin(steps.x, steps.y, 2000);
}

// Where rows share a time: the steps from row to row, as read and as used. Below the curve.
std::string time_panel(const std::vector<double>& read, const std::vector<double>& used) {
  const Points raw = steps_of(read), spread = steps_of(used);
  return data_block("raw_steps", {raw.x, raw.y}) + data_block("used_steps", {spread.x, spread.y}) +
         x_range({raw.x}, 1.0) + panel(0.10, 0.27) + few_tics(raw.y, 1.0) +
         std::string(time_commands);
}

// How many rows were read until the last that is used; all where no time tells.
std::size_t rows_until_break(const calib::RawTest& raw, const calib::MeasuredTest& test) {
  if (raw.time.empty() || test.time.empty()) return raw.rows();
  return static_cast<std::size_t>(std::ranges::upper_bound(raw.time, test.time.back()) -
                                  raw.time.begin());
}

// The recorded channels on the axes of a stress-strain plot, the load with the sign that it was
// used with, until the break and after it; empty where one was not recorded.
struct RawPoints {
  Points loading, after_break;
};

RawPoints raw_points(const calib::RawTest& raw, const calib::MeasuredTest& test) {
  std::vector<double> strain = raw.strain, stress = raw.stress;
  if (strain.empty() && raw.gauge_length)
    for (const double extension : raw.extension) strain.push_back(extension / *raw.gauge_length);
  if (!raw.force.empty() && test.area > 0.0) {
    stress = raw.force;
    for (double& value : stress) value /= test.area;
  }
  if (test.load_turned && !raw.load_turned)  // a joined test comes turned
    for (double& value : stress) value = -value;
  const std::size_t rows = std::min(strain.size(), stress.size());
  const std::size_t kept = std::min(rows, rows_until_break(raw, test));
  const std::span<const double> x(strain.data(), rows), y(stress.data(), rows);
  return {thin(x.first(kept), y.first(kept), 2000), thin(x.subspan(kept), y.subspan(kept), 2000)};
}

constexpr std::string_view record_commands = R"gnuplot(
set xlabel '{x_label}' offset 0,0.5
set ylabel '{y_label}'
unset key
plot $raw using 1:2 with lines lw 1.6 lc rgb dark
)gnuplot";

// What was recorded, where it cannot be turned into stress and strain.
void draw_record(const calib::RawTest& raw, Figure& figure) {
  const bool travelled = !raw.extension.empty(), loaded = !raw.force.empty();
  std::vector<double> x = travelled ? raw.extension : raw.time;
  std::vector<double> y = loaded ? raw.force : raw.stress;
  for (double& value : x) value /= travelled ? in::mm : 1.0;
  for (double& value : y) value /= loaded ? 1.0 : in::MPa;
  const Points points = thin(x, y, 2000);
  const std::string range = x_range({points.x}, 1.0);
  if (range.empty()) return;
  figure.description = "The test as read";
  figure.commands =
      data_block("raw", {points.x, points.y}) + range + panel(0.155, 0.95) +
      fmt::format(record_commands, fmt::arg("x_label", travelled ? "Extension (mm)" : "Time (s)"),
                  fmt::arg("y_label", fmt::format("{}{}", loaded ? "Force (N)" : "Stress (MPa)",
                                                  raw.load_turned ? ", sign turned" : "")));
}

// The line of the modulus' slope through the middle of the points in its window.
Points modulus_line(const calib::MeasuredTest& test) {
  double strain = 0.0, stress = 0.0, inside = 0.0;
  for (std::size_t i = 0; i < std::min(test.strain.size(), test.stress.size()); ++i) {
    if (test.strain[i] < test.window_low || test.strain[i] > test.window_high) continue;
    strain += test.strain[i];
    stress += test.stress[i];
    inside += 1.0;
  }
  if (inside == 0.0) return {};
  const double offset = (stress - test.modulus * strain) / inside, end = 1.25 * test.window_high;
  return {{0.0, end}, {offset, offset + end * test.modulus}};
}

// A spike would press the curve into a corner: what lies far off leaves through the frame.
std::vector<double> near_curve(std::vector<double> values, const std::vector<double>& curve) {
  const auto [low, high] = std::ranges::minmax(curve);
  const double margin = 0.25 * (high - low);
  for (double& value : values) value = std::clamp(value, low - margin, high + margin);
  return values;
}

}  // namespace

Figure test_figure(const ImportReport& report, const std::string& id) {
  const calib::MeasuredTest& test = report.test;
  Figure figure{
      .id = id, .description = "Stress against strain, as read and as used", .height = 400};
  if (test.strain.empty()) {
    draw_record(report.raw, figure);
    return figure;
  }
  const auto [raw, rest] = raw_points(report.raw, test);
  const Points used = thin(test.strain, test.stress);
  if (used.x.empty()) return figure;
  std::vector<double> stresses = used.y, strains = used.x;
  for (const Points* part : {&raw, &rest}) {
    std::ranges::copy(near_curve(part->x, used.x), std::back_inserter(strains));
    std::ranges::copy(near_curve(part->y, used.y), std::back_inserter(stresses));
  }
  const std::string range = x_range({strains}, 100.0);
  if (range.empty()) return figure;
  const auto [lowest, highest] = std::ranges::minmax(stresses);
  const Points line = modulus_line(test);
  const std::array<double, 1> peak_strain{test.failure_strain}, peak_stress{test.strength};
  // If rows share a time, a second panel shows how they were spread over it.
  const bool shared_times = std::ranges::adjacent_find(report.raw.time) != report.raw.time.end();
  if (shared_times) figure.height = 580;
  figure.commands =
      (shared_times ? "set multiplot\n" : "") + data_block("raw", {raw.x, raw.y}) +
      data_block("rest", {rest.x, rest.y}) + data_block("used", {used.x, used.y}) +
      data_block("line", {line.x, line.y}) + data_block("peak", {peak_strain, peak_stress}) +
      range + (shared_times ? panel(0.41, 0.885) : panel(0.155, 0.84)) +
      fmt::format(test_commands, fmt::arg("low", 100.0 * test.window_low),
                  fmt::arg("high", 100.0 * test.window_high),
                  fmt::arg("as_read", test.load_turned ? "as read, sign turned" : "as read"),
                  fmt::arg("after_break", rest.x.empty() ? "" : after_break_plot),
                  fmt::arg("lowest", (std::min(0.0, lowest) - 0.03 * highest) / in::MPa),
                  fmt::arg("highest", 1.06 * highest / in::MPa)) +
      (shared_times ? time_panel(report.raw.time, test.time) : "");
  return figure;
}

}  // namespace havers::reports
