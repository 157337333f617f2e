// The figures of the pages. Every one takes the id that keeps it apart from others on its page.
#pragma once

#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
#include "calib/synthetic/chain_benchmark.hpp"
#include "reports/figures/gnuplot.hpp"
#include "reports/pages.hpp"

namespace havers::reports {

/// Measured and simulated curve of a specimen with the band of its replicates; below, their
/// difference.
Figure specimen_figure(const calib::SpecimenResult& specimen, const std::string& id);

/// Measured against simulated strength of all specimens, with error bars and the line of equality.
Figure strength_figure(const std::vector<calib::SpecimenResult>& specimens, const std::string& id);

/// 95 % intervals of the parameters of several fits, one panel a parameter.
Figure intervals_figure(const std::vector<FitReport>& fits, const std::string& id);

/// Rise of the cost along each parameter, with the level of the 95 % interval.
Figure profile_figure(const std::vector<calib::Profile>& profiles, const std::string& id);

/// Costs of all starts of a search and of those refined, lowest first.
Figure waterfall_figure(const calib::CalibrationResult& result, const std::string& id);

/// Whether time steps take so much energy that it is drawn.
bool loses_energy(const sim::Simulation& simulation);
/// Stress, broken joints and energies of a simulation against strain.
Figure simulation_figure(const SimulationReport& report, const std::string& id);

/// A test as read and as used, with the modulus line and the strength.
Figure test_figure(const ImportReport& report, const std::string& id);

/// Two recorders' signals as recorded and on one clock; below, their difference.
Figure clocks_figure(const calib::ClockFit& clocks, const std::string& id);

/// Pixels of a section by depth, with the threshold.
Figure histogram_figure(const calib::DepthHistogram& histogram, const std::string& id);

/// Error of porosity against CPU time, of every drawn section by every method.
Figure methods_figure(const calib::MethodComparison& comparison, const std::string& id);

/// Median error of every chain of optimisers when it has cost so much: simulations, or wall time.
enum class ChainCost { simulations, seconds };
Figure chains_figure(const calib::ChainBenchmark& benchmark, ChainCost cost, const std::string& id);

/// An interval between its bounds, small enough for a table. SVG.
std::string interval_bar(const calib::CalibratedParameter& parameter);

}  // namespace havers::reports
