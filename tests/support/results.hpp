// Results as the rooms hand them to the reports: plausible, made from closed forms and a fixed
// generator.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "calib/fit/calibration.hpp"
#include "sim/assembly/assembly.hpp"
#include "sim/simulation.hpp"

namespace havers::test {

inline bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A PNG of one pixel.
inline std::vector<std::uint8_t> tiny_png() {
  return {0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    0x0d, 'I',  'H',
          'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,
          0,    0x3a, 0x7e, 0x9b, 0x55, 0,    0,    0,    0x0a, 'I',  'D',  'A',  'T',  0x78,
          0x9c, 0x63, 0xf8, 0x0f, 0x00, 0x01, 0x01, 0x01, 0x00, 0x1b, 0xb6, 0xee, 0x56, 0,
          0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
}

/// A linear test to `strength` with noise, a toe and a sudden end.
inline calib::RawTest raw_test(double modulus, double strength, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  calib::RawTest raw;
  raw.specimen_id = "A1";
  raw.width = 4e-3;
  raw.thickness = 2e-3;
  raw.gauge_length = 25e-3;
  const double failure = strength / modulus, area = 8e-6, toe = 2e-4;
  for (int i = 0; i < 3000; ++i) {
    const double strain = 1.15 * failure * i / 2999.0;
    const double stress = strain < failure ? modulus * strain : 0.02 * strength;
    raw.time.push_back(0.01 * i);
    raw.strain.push_back(strain + toe * std::min(1.0, 20.0 * strain / failure) +
                         2e-6 * noise(random));
    raw.force.push_back(area * stress + 1.5 * noise(random));
  }
  return raw;
}

/// What a reduction of raw_test would say.
inline calib::MeasuredTest measured_test(double modulus, double strength, unsigned seed) {
  const calib::RawTest raw = raw_test(modulus, strength, seed);
  const double failure = strength / modulus;
  calib::MeasuredTest test;
  test.area = 8e-6;
  test.modulus = modulus;
  test.modulus_standard_error = 0.006 * modulus;
  test.window_low = 0.1 * failure;
  test.window_high = 0.4 * failure;
  test.max_force = 8e-6 * strength;
  test.strength = strength;
  test.strength_standard_error = 0.004 * strength;
  test.failure_strain = failure;
  test.strain_rate = 3.3e-4;
  test.linearity = 0.98;
  for (std::size_t i = 0; i < raw.strain.size(); ++i) {
    const double strain = raw.strain[i] - 2e-4;
    if (strain < 0.0 || strain > failure) continue;
    test.strain.push_back(strain);
    test.stress.push_back(raw.force[i] / test.area);
  }
  test.corrections = {{"toe", "strain shifted by 2.0e-4"},
                      {"cut after break", "391 rows after the peak"}};
  return test;
}

/// Simulated curves that break a little apart from each other around `strength`.
inline calib::CurveBand curve_band(const calib::MeasuredTest& test, double modulus,
                                   double strength) {
  calib::CurveBand band;
  for (int i = 0; i <= 200; ++i) {
    const double strain = 1.2 * test.failure_strain * i / 200.0;
    const auto curve = [&](double factor) {
      const double peak = factor * strength / modulus;
      return strain <= peak ? modulus * strain
                            : factor * strength * std::exp(-(strain - peak) / (0.02 * peak));
    };
    band.strain.push_back(strain);
    band.median.push_back(curve(1.0));
    band.lower.push_back(curve(0.95));
    band.upper.push_back(curve(1.05));
    band.measured.push_back(strain < test.failure_strain ? test.modulus * strain : nan);
    band.residual.push_back(band.median.back() - band.measured.back());
  }
  return band;
}

inline calib::SpecimenResult specimen_result(std::string id, double degrees, double strength,
                                             unsigned seed) {
  const double modulus = 13e9 + 1e8 * seed;
  calib::SpecimenResult s;
  s.id = std::move(id);
  s.use = seed % 3 == 0 ? calib::Use::validate : calib::Use::fit;
  s.orientation = degrees * std::numbers::pi / 180.0;
  s.porosity = 0.04 + 0.005 * seed;
  s.scatter = 0.3 + 0.05 * seed;
  s.measured = measured_test(modulus, strength * (1.0 + 0.01 * (seed % 4)), seed);
  s.modulus = {1.01 * modulus, 0.004 * modulus};
  s.strength = {strength, 0.02 * strength};
  s.failure_strain = {strength / (1.01 * modulus), 0.0001};
  s.residual = {1.2, -0.4, 0.31};
  s.band = curve_band(s.measured, 1.01 * modulus, strength);
  return s;
}

inline calib::SectionPorosity section_sample(std::string file) {
  calib::SectionPorosity section;
  section.file = std::move(file);
  section.pixel_size = 5e-6;
  section.method = "half maximum";
  section.threshold = 0.49;
  section.porosity = 0.048;
  section.porosity_standard_error = 0.0021;
  section.pore_count = 213;
  section.pore_area = 3.1e-7;
  section.bone_area = 6.5e-6;
  section.window_sd = 0.11;
  return section;
}

/// A study with its result: six specimens in three orientations, one parameter left out.
struct FitSample {
  calib::Study study;
  calib::CalibrationResult result;
};

inline FitSample fit_sample() {
  FitSample f;
  f.study.name = "bovine femur A";
  auto& r = f.result;
  r.status = calib::CalibrationStatus::converged;
  r.verdict = {{"search", calib::Outcome::pass, "both optimisers stopped at the same minimum"},
               {"goodness of fit", calib::Outcome::pass, "χ² = 9.8 for 14 degrees of freedom"},
               {"bounds", calib::Outcome::pass, "no parameter lies at a bound"},
               {"failed simulations", calib::Outcome::warn, "12 of 4128 simulations failed"}};
  r.parameters = {
      {.name = "young_GPa",
       .unit = "GPa",
       .value = 13.1234,
       .standard_error = 0.0871,
       .interval_95 = {12.9494, 13.2974},
       .bounds = {5.0, 30.0},
       .identifiable = true},
      {.name = "head_tail_MPa",
       .unit = "MPa",
       .value = 52.41,
       .standard_error = 0.93,
       .interval_95 = {50.57, 54.25},
       .bounds = {5.0, 200.0},
       .identifiable = true},
      {.name = "ratio",
       .unit = "",
       .value = 1.0,
       .standard_error = nan,
       .interval_95 = {nan, nan},
       .bounds = {0.1, 10.0},
       .left_out_because = "its change moves no residual by more than 0.02 standard deviations"}};
  const double degrees[] = {0, 0, 45, 45, 90, 90};
  const double strength[] = {43.1e6, 45.9e6, 31.2e6, 29.8e6, 17.4e6, 18.8e6};
  for (unsigned i = 0; i < 6; ++i) {
    const std::string id = "A" + std::to_string(i + 1);
    r.specimens.push_back(specimen_result(id, degrees[i], strength[i], i + 1));
    calib::Specimen specimen;
    specimen.id = id;
    specimen.sections.push_back(section_sample(id + "_s1.png"));
    f.study.specimens.push_back(specimen);
  }
  r.specimens[1].failed_simulations = 12;
  r.specimens[4].measured.warnings = {"The force channel is coarse: 0.5 N per step."};
  r.stages = {
      {"NLopt BOBYQA", 1204.5, 8.31, 214, "parameters changed by less than 1e-4", 21.4},
      {"Ceres Levenberg-Marquardt", 8.31, 7.942, 48, "the cost changed by less than 1e-8", 6.25}};
  r.left_out = {{"ratio", "no specimen informs it"}, {"time steps", "the loading is quasi-static"}};
  r.cost = 7.942;
  r.evaluations = 4128;
  r.distinct_simulations = 4000;
  r.simulated = 3980;
  r.failed_simulations = 12;
  return f;
}

/// An assembly pulled apart along a stepped line through its middle.
inline sim::Simulation simulation_sample(const sim::Assembly& assembly) {
  sim::Simulation s;
  s.status = sim::SimulationStatus::broken;
  s.regime_ground = "inertia carries more than 1 % of the strength at 1000 1/s";
  s.step = 2e-8;
  s.step_accuracy = 1e-3;
  s.end_fraction_used = 0.3;
  s.displacements = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(assembly.nodes.size()));
  s.joints.resize(assembly.joints.size());
  const auto right = [&](const sim::Body& body) {
    double x = 0.0;
    for (int k = 0; k < body.nodes; ++k)
      x += assembly.nodes[static_cast<std::size_t>(body.first_node + k)].x() / body.nodes;
    return x > 0.5 * assembly.width;
  };
  for (const sim::Body& body : assembly.bodies)
    for (int k = 0; right(body) && k < body.nodes; ++k)
      s.displacements(2 * (body.first_node + k)) = 0.004 * assembly.width;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const sim::Joint& joint = assembly.joints[i];
    s.joints[i].threshold = {1.0, 1.0};  // none is missing
    s.joints[i].broken = right(assembly.bodies[static_cast<std::size_t>(joint.body_a)]) !=
                         right(assembly.bodies[static_cast<std::size_t>(joint.body_b)]);
    s.broken_joints += s.joints[i].broken ? 1 : 0;
  }
  for (int i = 0; i <= 400; ++i) {
    const double strain = 1e-5 * i, broken = std::clamp((i - 300) / 40.0, 0.0, 1.0);
    const double stress = 13e9 * strain * (1.0 - broken) + 2e5 * std::sin(0.4 * i);
    s.curve.push_back({2e-8 * i, strain, stress, stress + 3e5 * std::cos(0.4 * i),
                       static_cast<int>(broken * s.broken_joints), 1e-7 * (1.0 + 2.0 * broken),
                       4e-6 * std::pow(i / 300.0, 2) * (1.0 - broken), 3e-6 * broken});
  }
  s.strength = 38.9e6;
  s.failure_strain = 0.003;
  s.modulus = 13e9;
  s.first_break_strain = 0.0029;
  s.steps = 400;
  s.iterations = 5127;
  s.energy_defect = 3.2e-14;
  s.tolerance = 1e-8;
  s.worst_residual = 6.1e-10;
  s.residual_to_strength = 5.9e-10;
  s.left_out = {{"snapshots", "none were asked for"},
                {"time steps up to a strain of 3.978e-06", "the motion is known until then"}};
  return s;
}

}  // namespace havers::test
