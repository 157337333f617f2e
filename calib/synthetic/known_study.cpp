#include "calib/synthetic/known_study.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "calib/study/parameter.hpp"
#include "calib/synthetic/laboratory_record.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {
namespace {

// Range from which the truth is drawn, evenly in its logarithm, in the parameter's unit. It is
// narrower than the bounds of the search.
std::pair<double, double> range_of_truth(std::string_view parameter) {
  if (parameter == "young_GPa") return {10.0, 20.0};
  if (parameter == "head_tail_MPa") return {50.0, 110.0};
  if (parameter == "ratio") return {0.7, 2.5};
  assert(parameter == "scatter");
  return {0.2, 0.8};
}

// A number between 0 and 1 by study and purpose alone: 53 bits, and a half so that it is never 0.
double fraction(int study, std::uint64_t purpose) {
  return (static_cast<double>(specimen_seed(static_cast<std::uint64_t>(study), purpose) >> 11U) +
          0.5) *
         0x1p-53;
}

// Purposes of a study's random numbers, apart from those of the truth, which are 0, 1, 2; a
// specimen's number is added.
enum class Purpose : std::uint64_t { seed = 100, modulus = 200, strength = 300, fit = 400 };

std::uint64_t number_of(Purpose purpose, std::size_t specimen) {
  return static_cast<std::uint64_t>(purpose) + specimen;
}

Study empty_study(const Design& design, int number) {
  Study study;
  study.name = fmt::format("{}, study {}", design.name, number);
  study.model.assembly.layers = 8;
  study.model.assembly.fibres = 6;
  study.model.joints.scatter = 0.3;
  study.model.loading.strain_rate = 1e-3;
  // There are no sections: the scatter is the model's, or is calibrated.
  study.porosity.to_scatter = ToScatter::none;
  study.calibrate.parameters.assign(design.parameters.begin(), design.parameters.end());
  study.calibrate.bounds = {{"head_tail_MPa", {20.0, 250.0}}, {"ratio", {0.3, 6.0}}};
  study.calibrate.replicates = 4;
  // Profiles cost simulations and are no part of a search; `measure_coverage` turns them on.
  study.calibrate.profiles = false;
  // With one seed for all studies their fits would err alike.
  study.calibrate.seed =
      specimen_seed(static_cast<std::uint64_t>(number), number_of(Purpose::fit, 0));
  return study;
}

// The truth with what is this specimen's own.
sim::Scene scene_of(const KnownStudy& known, const Design& design, int number,
                    std::size_t specimen) {
  sim::Scene scene = known.study.model;
  scene.assembly.orientation = design.degrees[specimen] * degree;
  const auto own = [&](Purpose purpose) {
    return std::exp(design.specimen_effect *
                    gsl_cdf_ugaussian_Pinv(fraction(number, number_of(purpose, specimen))));
  };
  for (std::size_t k = 0; k < known.truth.size(); ++k)
    apply(scene, known.parameters.at(k), known.truth.at(k));
  scene.material.young *= own(Purpose::modulus);
  const double strength = own(Purpose::strength);
  // Both stresses, so that the specimen keeps the ratio.
  scene.joints.head_tail *= strength;
  scene.joints.flank *= strength;
  scene.joints.seed =
      specimen_seed(static_cast<std::uint64_t>(number), number_of(Purpose::seed, specimen));
  return scene;
}

}  // namespace

Design three_orientations() {
  return {.name = "0, 45, 90 deg", .degrees = {0.0, 0.0, 45.0, 45.0, 90.0, 90.0}};
}

Design unknown_scatter() {
  Design design = three_orientations();
  design.name += ", scatter unknown";
  design.parameters = {"young_GPa", "ratio", "scatter"};
  return design;
}

KnownStudy known_study(const Design& design, int number) {
  std::array<double, known_parameters.size()> truth{};
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto [low, high] = range_of_truth(design.parameters.at(k));
    truth.at(k) = low * std::pow(high / low, fraction(number, k));
  }
  return known_study(design, number, truth);
}

KnownStudy known_study(const Design& design, int number, const std::array<double, 3>& truth) {
  KnownStudy known{
      .study = empty_study(design, number), .parameters = design.parameters, .truth = truth};
  // Rows by the weakest specimens, which part at a tenth of the others' strain, and channels of the
  // class that (F5) takes them for.
  const Laboratory laboratory{.sampling = 0.02, .toe_strain = 0.0, .gain_error = 1e-3};
  for (std::size_t s = 0; s < design.degrees.size(); ++s) {
    const sim::Scene scene = scene_of(known, design, number, s);
    const sim::Simulation simulation = sim::simulate(scene);
    // A laboratory would have no such test: the study then has one specimen less.
    if (!is_test(simulation)) continue;
    Specimen specimen;
    specimen.id = fmt::format("S{}", s + 1);
    specimen.orientation = scene.assembly.orientation;
    // Recorded and reduced as a study's tests are, so that the errors of both are in it.
    specimen.test = reduce_test(record_test(simulation, Bar{}, laboratory, scene.joints.seed)).test;
    known.study.specimens.push_back(std::move(specimen));
  }
  return known;
}

Rate rate_of(int successes, int n) {
  // Without studies nothing is known, and any part is possible.
  if (n == 0) return {.part = std::nan(""), .interval_95 = {0.0, 1.0}};
  const double count = n, part = successes / count, z = gsl_cdf_ugaussian_Pinv(0.975);
  const double middle = (part + 0.5 * z * z / count) / (1.0 + z * z / count);
  const double half = z / (1.0 + z * z / count) *
                      std::sqrt(part * (1.0 - part) / count + 0.25 * z * z / (count * count));
  return {part, {middle - half, middle + half}};
}

std::array<double, 3> quantiles_of(std::vector<double> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  const auto at = [&](double part) {
    return gsl_stats_quantile_from_sorted_data(values.data(), 1, values.size(), part);
  };
  return {at(0.1), at(0.5), at(0.9)};
}

}  // namespace havers::calib
