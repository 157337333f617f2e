// A figure of a sweep is split twice: into panels by the values of one key, and each panel into
// series by those of another. The points of a series in a panel make a line.
#include "reports/sweep/sweep_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "calib/sweep/measure_words.hpp"
#include "reports/figures/thin.hpp"
#include "reports/sweep/sweep_words.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

using calib::PointGroup;

constexpr std::array<std::string_view, 7> colours{"blue",   "red",  "green", "orange",
                                                  "purple", "dark", "grey"};

// What a panel is drawn from.
struct Panel {
  const calib::Sweep& sweep;
  const calib::SweepResult& result;
  const calib::SweepFigure& wanted;
  const PointGroup& group;
};

std::string title_of(const Panel& panel, const std::string& value) {
  return panel.wanted.series.empty() ? "" : plain(typeset(value));
}

// Panels are narrower than a single figure, as several share a row of the page. [px]
double width_of(const calib::SweepFigure& wanted) {
  return wanted.per.empty() ? 640 : 420;
}

// Of a text in the figures' font, roughly. [px]
double width_of(std::string_view text) {
  constexpr double character = 7.5;
  const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return character * static_cast<double>(std::ranges::count_if(text, is_first_byte));
}

// The series' values beside the graph, under the name of their key, which leaves them room.
std::string key_of(const Panel& panel) {
  if (panel.wanted.series.empty()) return "set tmargin at screen 0.96\n";
  constexpr double sample = 58, margin = 12;  // [px]
  double room = width_of(name_of_key(panel.wanted.series));
  for (const PointGroup& series :
       calib::groups_of(panel.result.points, panel.sweep.plan, panel.wanted.series))
    room = std::max(room, sample + width_of(title_of(panel, series.value)));
  const double widest = panel.wanted.per.empty() ? 0.82 : 0.74;
  const double edge = std::clamp(1.0 - (room + margin) / width_of(panel.wanted), 0.5, widest);
  return fmt::format(
      "set tmargin at screen 0.96\nset rmargin at screen {}\n"
      "set key at screen {}, screen 0.96 left top vertical title '{}' noenhanced left\n",
      edge, edge + 0.01, plain(name_of_key(panel.wanted.series)));
}

// All series of the figure, but only their points in this panel; some may be empty.
std::vector<PointGroup> series_of(const Panel& panel) {
  std::vector<PointGroup> all =
      calib::groups_of(panel.result.points, panel.sweep.plan, panel.wanted.series);
  for (PointGroup& series : all)
    std::erase_if(series.points, [&](std::size_t point) {
      return std::ranges::find(panel.group.points, point) == panel.group.points.end();
    });
  return all;
}

struct Line {
  std::vector<double> x, mean, low, high;
  bool joined = true;
};

// Whether every key goes one way along the points, as on a curve: a line would join unlike ones.
bool go_one_way(const calib::SweepResult& result, const std::vector<std::size_t>& points) {
  for (std::size_t key = 0; key < result.points.front().numbers.size(); ++key) {
    const auto value = [&](std::size_t point) { return result.points[point].numbers[key]; };
    if (!std::ranges::is_sorted(points, {}, value) &&
        !std::ranges::is_sorted(points, std::greater{}, value))
      return false;
  }
  return true;
}

Line line_of(const Panel& panel, std::vector<std::size_t> points) {
  const std::size_t column = panel.sweep.plan.column(panel.wanted.x);
  const auto x_of = [&](std::size_t point) { return panel.result.points[point].numbers[column]; };
  // Points of the same x keep their order.
  std::ranges::stable_sort(points, {}, x_of);
  const double scale = calib::words_of(panel.wanted.response).scale;
  Line line{.joined = go_one_way(panel.result, points)};
  for (const std::size_t point : points) {
    const calib::PointSummary& summary = panel.result.summaries[point];
    const calib::Statistics& s = summary[panel.wanted.response];
    // Where some did not break, the others are the weaker ones.
    const bool some_open = summary.unbroken > 0 && calib::needs_break(panel.wanted.response);
    if (s.n == 0 || some_open) continue;
    // The mean of a single run has no interval: NaN.
    const double half = s.n > 1 ? s.half_width() : std::numeric_limits<double>::quiet_NaN();
    line.x.push_back(x_of(point));
    line.mean.push_back(s.mean / scale);
    line.low.push_back((s.mean - half) / scale);
    line.high.push_back((s.mean + half) / scale);
  }
  return line;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(),
         high = -std::numeric_limits<double>::infinity();

  void take(const std::vector<double>& values) {
    for (const double value : values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] bool many_decades() const { return low > 0.0 && high >= 100.0 * low; }
};

std::string log_axis(char axis, const Extent& range) {
  return fmt::format("set logscale {0}\nset format {0} '10^{{%T}}'\nset {0}range [{1}:{2}]\n", axis,
                     0.7 * range.low, 1.4 * range.high);
}

// gnuplot's own tics would write all zeros of such numbers.
std::string tics_of_small(char axis, const Extent& range) {
  if (range.high >= 1e-3 || !(range.high > range.low) || range.low < 0.0) return {};
  return fmt::format("set format {0} '%h'\nset {0}tics {1}\n", axis,
                     round_down((range.high - range.low) / 4.0));
}

std::string axes(const std::vector<Line>& lines) {
  Extent x, y;
  for (const Line& line : lines) {
    x.take(line.x);
    y.take(line.mean);
    y.take(line.low);
    y.take(line.high);
  }
  // The margin around a single value of x.
  const double alone = x.high != 0.0 ? 0.1 * std::abs(x.high) : 1.0;
  const double margin = x.high > x.low ? 0.04 * (x.high - x.low) : alone;
  return (x.many_decades() ? log_axis('x', x)
                           : fmt::format("{}set xrange [{}:{}]\n", tics_of_small('x', x),
                                         x.low - margin, x.high + margin)) +
         (y.many_decades()
              ? log_axis('y', y)
              : fmt::format("{}set yrange [{}*:*]\nset offsets 0, 0, graph 0.06, graph 0.06\n",
                            tics_of_small('y', y), y.low >= 0.0 ? "0<" : ""));
}

// Means with the band of their 95 % intervals, which a single run has not, a line for each series.
// Every line has its dashes and every second large open symbols, so that of two that coincide both
// are seen.
std::string mean_commands(const Panel& panel) {
  std::string data, bands, marks;
  std::vector<Line> lines;
  const bool sample = is_sample(panel.sweep.plan.sampling);
  const std::vector<PointGroup> all = series_of(panel);
  for (std::size_t i = 0; i < all.size(); ++i) {  // `i` fixes its look in all panels
    const Line line = line_of(panel, all[i].points);
    if (line.x.empty()) continue;
    // Points of a random sample are not joined: they are neighbours by chance.
    const bool joined = line.joined && !sample;
    const std::string_view colour = colours.at(i % colours.size());
    data += data_block(fmt::format("s{}", i), {line.x, line.mean, line.low, line.high});
    if (joined)
      bands += fmt::format(
          "$s{} using 1:3:4 with filledcurves fs transparent solid 0.25 lc rgb {} notitle, ", i,
          colour);
    const std::string symbol =
        fmt::format("pt {} ps {}", 4 + 2 * (i % 5) + (i % 2 == 0 ? 0 : 1), i % 2 == 0 ? 1.1 : 0.7);
    marks += fmt::format(
        "{0}$s{1} using 1:($3 == $3 ? $2 : NaN):3:4 with yerrorbars {2} lw 1.2 lc rgb {3} notitle, "
        "$s{1} using 1:2 with {4} lw 1.6 dt {5} {2} lc rgb {3} title '{6}'",
        marks.empty() ? "" : ", ", i, symbol, colour, joined ? "linespoints" : "points", 1 + i % 5,
        title_of(panel, all[i].value));
    lines.push_back(line);
  }
  if (lines.empty()) return {};
  const calib::MeasureWords words = calib::words_of(panel.wanted.response);
  return data + axes(lines) + key_of(panel) +
         fmt::format(
             "set xlabel '{}' offset 0,0.4 noenhanced\nset ylabel '{}{}' offset 0.5,0\n"
             "plot {}{}\n",
             plain(name_of_key(panel.wanted.x)), plain(words.name),
             words.unit.empty() ? "" : fmt::format(" ({})", words.unit), bands, marks);
}

// Stress against strain of the first seed of each series that has not failed.
std::string curve_commands(const Panel& panel) {
  std::string data, plots;
  const std::vector<PointGroup> all = series_of(panel);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].points.empty()) continue;
    const auto run = std::ranges::find_if(panel.result.runs, [&](const calib::SweepRun& one) {
      return one.point == all[i].points.front() && !one.failed && !one.strain.empty();
    });
    if (run == panel.result.runs.end()) continue;
    const Points points = thin(run->strain, run->stress);
    data += data_block(fmt::format("s{}", i), {points.x, points.y});
    plots +=
        fmt::format("{}$s{} using ($1*100):($2*1e-6) with lines lw 1.6 dt {} lc rgb {} title '{}'",
                    plots.empty() ? "" : ", ", i, 1 + i % 5, colours.at(i % colours.size()),
                    title_of(panel, all[i].value));
  }
  if (plots.empty()) return {};
  return data + key_of(panel) +
         fmt::format(
             "set xlabel 'Strain (%)' offset 0,0.4\nset ylabel 'Stress (MPa)' offset 0.5,0\n"
             "set yrange [0:*]\nset offsets 0, graph 0.03, graph 0.06, 0\nplot {}\n",
             plots);
}

}  // namespace

std::vector<SweepPanel> sweep_figures(const calib::Sweep& sweep, const calib::SweepResult& result,
                                      const calib::SweepFigure& wanted, const std::string& id) {
  std::vector<SweepPanel> panels;
  for (const PointGroup& group : calib::groups_of(result.points, sweep.plan, wanted.per)) {
    const Panel panel{sweep, result, wanted, group};
    SweepPanel made{.at = wanted.per.empty() ? "" : place(wanted.per, group.value),
                    .figure = {.id = fmt::format("{}-{}", id, panels.size()),
                               .description = wanted.caption,
                               .width = static_cast<int>(width_of(wanted)),
                               .height = wanted.per.empty() ? 360 : 340}};
    // A figure without a key for its x axis shows stress-strain curves of runs.
    made.figure.commands = wanted.x.empty() ? curve_commands(panel) : mean_commands(panel);
    if (!made.figure.commands.empty())  // as much room as the labels of the tics ask for
      made.figure.commands =
          fmt::format("unset lmargin\n{}{}", wanted.per.empty() ? "" : "set xtics font ',10'\n",
                      made.figure.commands);
    panels.push_back(std::move(made));
  }
  return panels;
}

}  // namespace havers::reports
