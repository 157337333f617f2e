// Three panels over one strain axis: stress, broken joints by kind, energies. Rows may be far
// apart: between them a curve is drawn as it must run there, which need not be a straight line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

constexpr std::size_t most_points = 2000;  // Of a curve, besides those at which a joint broke.

constexpr std::string_view simulation_commands = R"gnuplot(
set multiplot
{range}{top}
set xtics format ''
set ylabel 'Stress (MPa)'
plot {left}$curve using ($1*100):($2*1e-6) with lines lw 1.8 lc rgb blue title '{right}'
{middle}
set ylabel 'Broken joints'
{counts}
plot $head_tail using ($1*100):2 with steps lw 1.8 lc rgb red title 'head-tail', \
  $flank using ($1*100):2 with steps lw 1.8 dt 2 lc rgb blue title 'flank'
{bottom}
set yrange [0:*]
set ytics autofreq
set xtics format '%g'
set xlabel 'Strain (%)' offset 0,0.5
set key samplen 3 width -2
set ylabel 'Energy ({unit}J/m)'
plot $curve using ($1*100):($5/{factor}) with lines lw 1.8 lc rgb blue title 'elastic', \
  $curve using ($1*100):($6/{factor}) with lines lw 1.8 dt 2 lc rgb red title 'dissipated', \
  $curve using ($1*100):($7/{factor}) with lines lw 1.8 dt 4 lc rgb green title 'kinetic'{lost}
unset multiplot
)gnuplot";

constexpr std::string_view taken_by_steps =
    ", $curve using ($1*100):($8/{factor}) with lines lw 1.8 dt 5 lc rgb orange title 'lost'";
constexpr std::string_view left_side =
    "$curve using ($1*100):($3*1e-6) with lines lw 1.4 dt 2 lc rgb orange title 'left side', ";

// A quasi-static run has rows at breaks only, and one in time leaps to the first: between rows
// stress grows with the strain, energy and what friction takes with its square, what viscosity
// takes with the time.
std::vector<sim::CurvePoint> with_parabolas(const sim::Simulation& simulation) {
  const bool dynamic = simulation.regime == sim::Regime::dynamic;
  if (dynamic && simulation.leapt_strain == 0.0) return simulation.curve;
  constexpr int parts = 60;
  // All pieces have the same length in strain.
  const double piece = simulation.curve.back().strain / parts;
  std::vector<sim::CurvePoint> curve;
  for (const sim::CurvePoint& end : simulation.curve) {
    const sim::CurvePoint begin = curve.empty() ? end : curve.back();
    const double gap = end.strain - begin.strain;
    if (dynamic && gap < simulation.leapt_strain) {
      curve.push_back(end);
      continue;
    }
    for (double strain = begin.strain + piece; strain < end.strain; strain += piece) {
      sim::CurvePoint& point = curve.emplace_back(begin);
      const double part = (strain - begin.strain) / gap;
      point.strain = strain;
      point.stress_right = std::lerp(begin.stress_right, end.stress_right, part);
      point.stress_left = std::lerp(begin.stress_left, end.stress_left, part);
      // Grows with the square of the strain up to the value of the next row.
      point.elastic = end.elastic * (strain * strain) / (end.strain * end.strain);
      const double grown =
          dynamic ? part : part * (strain + begin.strain) / (end.strain + begin.strain);
      point.dissipated = std::lerp(begin.dissipated, end.dissipated, grown);
    }
    curve.push_back(end);
  }
  return curve;
}

// Rows of a long run are thinned evenly; those at which a joint broke and the strongest all stay.
std::string curve_data(const std::vector<sim::CurvePoint>& curve) {
  const std::size_t stride = curve.size() / most_points + 1;
  const auto strongest = std::ranges::max_element(curve, {}, &sim::CurvePoint::stress_right);
  const auto peak = static_cast<std::size_t>(strongest - curve.begin());
  std::string block = "$curve << EOD\n";
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const bool breaks = i > 0 && curve[i].broken_joints != curve[i - 1].broken_joints;
    if (i % stride != 0 && i != peak && i + 1 != curve.size() && !breaks) continue;
    const sim::CurvePoint& p = curve[i];
    block += fmt::format("{:.6g} {:.6g} {:.6g} {} {:.6g} {:.6g} {:.6g} {:.6g}\n", p.strain,
                         p.stress_right, p.stress_left, p.broken_joints, p.elastic, p.dissipated,
                         p.kinetic, p.numerical);
  }
  return block + "EOD\n";
}

// Strains at which joints of a kind broke, in order; those missing from the start are no breaks.
std::vector<double> break_strains(const SimulationReport& report, sim::JointKind kind) {
  std::vector<double> strains;
  for (std::size_t j = 0; j < report.simulation.joints.size(); ++j) {
    const sim::JointOutcome& joint = report.simulation.joints[j];
    if (report.assembly.joints[j].kind == kind && joint.broke())
      strains.push_back(joint.broken_at_strain);
  }
  std::ranges::sort(strains);
  return strains;
}

// Joints of a kind, counted as they break.
std::string breaks_data(const std::vector<double>& strains, double end, std::string_view name) {
  std::string block = fmt::format("${} << EOD\n0 0\n", name);
  for (std::size_t i = 0; i < strains.size(); ++i)
    if (i + 1 == strains.size() || strains[i + 1] != strains[i])
      block += fmt::format("{:.9g} {}\n", strains[i], i + 1);
  return block + fmt::format("{:.9g} {}\nEOD\n", end, strains.size());
}

// An axis from 0 on with tics at whole numbers; of few counts gnuplot would show halves.
std::string count_axis(std::size_t most) {
  constexpr std::size_t few = 5;
  return fmt::format("set yrange [0:{}]{}", most == 0 ? "1" : "*",
                     most < few ? "\nset ytics 1" : "");
}

double largest_energy(const std::vector<sim::CurvePoint>& curve) {
  double largest = 0.0;
  for (const sim::CurvePoint& p : curve)
    for (const double energy : {p.elastic, p.dissipated, p.kinetic, p.numerical})
      if (std::isfinite(energy)) largest = std::max(largest, energy);
  return largest;
}

}  // namespace

bool loses_energy(const sim::Simulation& simulation) {
  constexpr double worth_drawing = 0.01;  // of all
  return simulation.numerical_loss >= worth_drawing;
}

Figure simulation_figure(const SimulationReport& report, const std::string& id) {
  const sim::Simulation& simulation = report.simulation;
  Figure figure{.id = id,
                .description = "Stress, broken joints of either kind and energies against strain",
                .height = 660};
  std::vector<double> strain;
  for (const sim::CurvePoint& point : simulation.curve) strain.push_back(point.strain);
  const std::string range = x_range({strain}, 100.0);
  if (range.empty()) return figure;
  const bool dynamic = simulation.regime == sim::Regime::dynamic;
  const Prefix prefix = prefix_for(largest_energy(simulation.curve));
  const std::vector<double> head_tail = break_strains(report, sim::JointKind::head_tail),
                            flank = break_strains(report, sim::JointKind::flank);
  figure.commands =
      curve_data(with_parabolas(simulation)) + breaks_data(head_tail, strain.back(), "head_tail") +
      breaks_data(flank, strain.back(), "flank") +
      fmt::format(
          simulation_commands, fmt::arg("range", range), fmt::arg("top", panel(0.66, 0.955)),
          fmt::arg("middle", panel(0.41, 0.595)),
          fmt::arg("counts", count_axis(std::max(head_tail.size(), flank.size()))),
          fmt::arg("bottom", panel(0.095, 0.345)), fmt::arg("left", dynamic ? left_side : ""),
          fmt::arg("right", dynamic ? "right side" : "stress"),
          fmt::arg("lost", loses_energy(simulation)
                               ? fmt::format(taken_by_steps, fmt::arg("factor", prefix.factor))
                               : ""),
          fmt::arg("unit", prefix.symbol), fmt::arg("factor", prefix.factor));
  return figure;
}

}  // namespace havers::reports
