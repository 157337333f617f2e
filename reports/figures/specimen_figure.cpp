// The measured and the simulated curve of a specimen, with the band of its replicates; below, their
// difference.
#include <fmt/format.h>

#include "reports/figures/figures.hpp"
#include "reports/figures/thin.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

constexpr std::string_view specimen_commands = R"gnuplot(
set multiplot
{range}{top}
set ylabel 'Stress (MPa)' offset 0.5,0
set yrange [0:*]
set xtics format ''
plot $band using ($1*100):($2*1e-6):($3*1e-6) with filledcurves lc rgb band title '95 % of the replicates', \
  $measured using ($1*100):($2*1e-6) with points pt 7 ps 0.28 lc rgb dark title 'measured', \
  $band using ($1*100):($4*1e-6) with lines lw 1.6 lc rgb blue title 'simulated, median', \
  $peak using ($1*100):($2*1e-6) with points pt 12 ps 1.3 lw 1.6 lc rgb red title '{end}'
{bottom}
unset key
set xtics format '%g'
set xlabel 'Strain (%)' offset 0,0.5
set ylabel 'Residual (MPa)' offset 0.5,0
{tics}set yrange [*:*]
set xzeroaxis lt 1 lw 1 lc rgb grey
plot $residual using ($1*100):($2*1e-6) with filledcurves y1=0 lc rgb band, \
  $residual using ($1*100):($2*1e-6) with lines lw 1.5 lc rgb blue
unset multiplot
)gnuplot";

// What a folder read back no longer holds of the raw curve, the band does.
Points measured_points(const calib::SpecimenResult& specimen) {
  if (!specimen.measured.strain.empty())
    return thin(specimen.measured.strain, specimen.measured.stress);
  return thin(specimen.band.strain, specimen.band.measured);
}

}  // namespace

Figure specimen_figure(const calib::SpecimenResult& specimen, const std::string& id) {
  Figure figure{
      .id = id,
      .description = fmt::format("Measured and simulated stress against strain of {}", specimen.id),
      .height = 430};
  const Points measured = measured_points(specimen);
  const calib::CurveBand& band = specimen.band;
  const std::string range = x_range({measured.x, band.strain}, 100.0);
  if (range.empty()) return figure;
  const std::vector<double> peak_strain{specimen.measured.failure_strain};
  const std::vector<double> peak_stress{specimen.measured.strength};
  figure.commands =
      data_block("measured", {measured.x, measured.y}) +
      data_block("band", {band.strain, band.lower, band.upper, band.median}) +
      data_block("residual", {band.strain, band.residual}) +
      data_block("peak", {peak_strain, peak_stress}) +
      fmt::format(specimen_commands, fmt::arg("range", range), fmt::arg("top", panel(0.40, 0.89)),
                  fmt::arg("end", specimen.measured.broke ? "measured strength" : "stopped here"),
                  fmt::arg("tics", few_tics(band.residual, 1.0 / in::MPa)),
                  fmt::arg("bottom", panel(0.145, 0.365)));
  return figure;
}

}  // namespace havers::reports
