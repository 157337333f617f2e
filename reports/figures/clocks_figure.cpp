// Three panels: each signal over its own recorder's time, both over the machine's, and their
// difference up to the break.
#include <fmt/format.h>

#include "reports/figures/figures.hpp"
#include "reports/figures/thin.hpp"

namespace havers::reports {
namespace {

constexpr std::string_view commands = R"gnuplot(
set multiplot
set ytics 0,50,100
set yrange [-10:115]
{recorded_range}{top}
set ylabel 'As recorded (%)'
set xlabel "Each recorder's own time (s)" offset 0,0.6
plot $machine using 1:($2*100) with lines lw 1.6 lc rgb dark title 'machine', \
  $logger using 1:($2*100) with lines lw 1.6 lc rgb blue title 'logger; each in % of its range'
{aligned_range}{middle}
unset xlabel
set xtics format ''
set ylabel 'Aligned (%)'
plot $machine using 1:($2*100) with lines lw 2.6 lc rgb '#b0b0b0' title 'machine', \
  $aligned using 1:($2*100) with lines lw 1.2 dt 2 lc rgb blue title "logger, on the machine's clock"
{bottom}
unset key
set xtics format '%g'
set xlabel "Machine's time (s)" offset 0,0.6
set ylabel 'Difference (%)'
set yrange [*:*]
{tics}set xzeroaxis lt 1 lw 1 lc rgb grey
plot $residual using 1:($2*100) with points pt 7 ps 0.2 lc rgb blue
unset multiplot
)gnuplot";

std::string block(std::string_view name, const calib::ClockTrace& trace) {
  const Points points = thin(trace.time, trace.part, 1000);
  return data_block(name, {points.x, points.y});
}

}  // namespace

Figure clocks_figure(const calib::ClockFit& clocks, const std::string& id) {
  Figure figure{
      .id = id,
      .description = "Signals of machine and logger as recorded, aligned, and their difference",
      .height = 560};
  const std::string aligned_range = x_range({clocks.machine.time}, 1.0);
  if (aligned_range.empty()) return figure;
  figure.commands =
      block("machine", clocks.machine) + block("logger", clocks.logger) +
      block("aligned", clocks.aligned) + block("residual", clocks.residual) +
      fmt::format(
          commands, fmt::arg("aligned_range", aligned_range),
          fmt::arg("recorded_range", x_range({clocks.machine.time, clocks.logger.time}, 1.0)),
          fmt::arg("tics", few_tics(clocks.residual.part, 100.0)),
          fmt::arg("top", panel(0.765, 0.91)), fmt::arg("middle", panel(0.355, 0.555)),
          fmt::arg("bottom", panel(0.11, 0.32)));
  return figure;
}

}  // namespace havers::reports
