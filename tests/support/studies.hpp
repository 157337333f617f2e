// Studies whose truth is known: a simulator in closed form, and tests drawn from it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "calib/fit/calibrate.hpp"
#include "calib/fit/simulation_batch.hpp"
#include "calib/study/parameter.hpp"
#include "calib/study/study.hpp"

namespace havers::test {

/// A standard normal number that is a function of the seed alone, by the mixer of SplitMix64: to
/// seed a Mersenne twister would take longer than all else of a simulation.
inline double normal_of(std::uint64_t seed) {
  const auto uniform = [seed](std::uint64_t turn) {
    std::uint64_t x = seed + turn * 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return (static_cast<double>((x ^ (x >> 31U)) >> 11U) + 0.5) * 0x1p-53;
  };
  return std::sqrt(-2.0 * std::log(uniform(1))) * std::cos(2.0 * std::numbers::pi * uniform(2));
}

/// A brittle law with the shape of the fibre model: strength = σ₁ (1 − d/2) g(θ, r) (1 + noise by
/// seed), modulus = E, straight up to the break. g is 1 at 0°, falls with r at 45° and does not
/// depend on r at 90°.
struct ClosedForm {
  double noise = 0.003;  ///< Standard deviation of log strength from seed to seed. [-]
  bool quasi_static = true;

  [[nodiscard]] static double orientation_factor(const sim::Scene& scene) {
    const double degrees = scene.assembly.orientation * 180.0 / std::numbers::pi;
    const double r = sim::ratio(scene.assembly, scene.joints);
    if (degrees < 1.0) return 1.0;
    return degrees > 89.0 ? 0.2 : 0.4 / (1.0 + r);
  }

  calib::Response operator()(const sim::Scene& scene) const {
    calib::Response response;
    response.failed = false;
    response.broke = true;
    response.modulus = scene.material.young;
    response.strength = scene.joints.head_tail * (1.0 - 0.5 * scene.joints.scatter) *
                        orientation_factor(scene) * std::exp(noise * normal_of(scene.joints.seed));
    response.failure_strain = response.strength / response.modulus;
    response.strain = {0.0, response.failure_strain, response.failure_strain};
    response.stress = {0.0, response.strength, 0.0};
    return response;
  }

  [[nodiscard]] calib::Simulator simulator() const {
    const bool scales = quasi_static;
    return {.run = *this, .quasi_static = [scales](const sim::Scene&) { return scales; }};
  }
};

/// A simulator that answers as the law does, but for what `change(response, scene)` makes of it.
template <class Change>
calib::Simulator altered(const Change& change, const ClosedForm& law = {}) {
  calib::Simulator simulator = law.simulator();
  simulator.run = [law, change](const sim::Scene& scene) {
    calib::Response response = law(scene);
    change(response, scene);
    return response;
  };
  return simulator;
}

/// A measured test as straight as a ruler, with the errors given as parts of the values.
inline calib::MeasuredTest straight_test(double modulus, double strength,
                                         double modulus_error = 1e-3,
                                         double strength_error = 1e-3) {
  constexpr int rows = 1000;
  calib::MeasuredTest test;
  test.modulus = modulus;
  test.modulus_standard_error = modulus_error * modulus;
  test.strength = strength;
  test.strength_standard_error = strength_error * strength;
  test.failure_strain = strength / modulus;
  for (int i = 0; i <= rows; ++i) {
    test.strain.push_back(test.failure_strain * i / rows);
    test.stress.push_back(strength * i / rows);
  }
  return test;
}

/// What the specimens of a synthetic study are made of.
struct Truth {
  double young_GPa = 14.0, head_tail_MPa = 60.0, ratio = 2.0, scatter = 0.3;
  double modulus_error = 2e-3, strength_error = 2e-3;  ///< Of the machine. [-]
  double specimen_effect = 0.0;  ///< Between specimens, of log modulus and log strength. [-]
};

/// Two specimens at each orientation, broken by the closed form on seeds of their own.
inline calib::Study synthetic_study(const std::vector<double>& degrees, const Truth& truth = {},
                                    unsigned draw = 1, const ClosedForm& law = {}) {
  std::mt19937_64 random(draw);
  std::normal_distribution<double> normal;
  calib::Study study;
  study.name = "synthetic";
  study.model.joints.scatter = truth.scatter;
  study.calibrate.threads = 1;
  for (const double angle : degrees) {
    for (int copy = 0; copy < 2; ++copy) {
      calib::Specimen specimen;
      specimen.id = std::string("S").append(std::to_string(study.specimens.size() + 1));
      specimen.orientation = angle * std::numbers::pi / 180.0;
      sim::Scene scene;
      scene.assembly.orientation = specimen.orientation;
      calib::apply(scene, "young_GPa", truth.young_GPa);
      calib::apply(scene, "head_tail_MPa", truth.head_tail_MPa);
      calib::apply(scene, "ratio", truth.ratio);
      calib::apply(scene, "scatter", truth.scatter);
      scene.joints.seed = random();
      const auto response = law(scene);
      const auto error = [&](double machine) {
        return std::exp(machine * normal(random) + truth.specimen_effect * normal(random));
      };
      const double modulus = response.modulus * error(truth.modulus_error);
      const double strength = response.strength * error(truth.strength_error);
      // straight_test ends on its last row; half a row is what target_of adds.
      specimen.test = straight_test(modulus, strength * (1.0 - 0.5e-3), truth.modulus_error,
                                    truth.strength_error);
      study.specimens.push_back(std::move(specimen));
    }
  }
  return study;
}

/// Twice as many specimens along the fibres as `pairs`, known alike, and a parameter of which one
/// term tells its own logarithm: the answer is a mean.
inline calib::Study one_mean_study(std::size_t pairs, const std::string& parameter,
                                   const std::string& term, const Truth& truth, unsigned draw = 1,
                                   const ClosedForm& law = {}) {
  calib::Study study = synthetic_study(std::vector<double>(pairs, 0.0), truth, draw, law);
  study.calibrate.parameters = {parameter};
  study.calibrate.terms = {term};
  return study;
}

inline calib::Study modulus_study(std::size_t pairs, unsigned draw = 1) {
  return one_mean_study(pairs, "young_GPa", "modulus", {.specimen_effect = 0.05}, draw);
}

inline double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Standard deviation by n − 1.
inline double deviation_of(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += std::pow(value - mean_of(values), 2);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1.0));
}

/// That of the logarithms of the moduli measured.
inline double deviation_of_moduli(const calib::Study& study) {
  std::vector<double> logarithms;
  for (const auto& specimen : study.specimens)
    logarithms.push_back(std::log(specimen.test.modulus));
  return deviation_of(logarithms);
}

inline const std::vector<double> three_orientations{0.0, 45.0, 90.0};

/// Two specimens at 0, 45 and 90 degrees whose strengths are known to 7, 4 and 0.2 %.
inline calib::Study unequally_known_study(unsigned draw, const Truth& truth = {}) {
  calib::Study study = synthetic_study(three_orientations, truth, draw);
  study.calibrate.replicates = 4;
  std::mt19937_64 random(draw);
  std::normal_distribution<double> normal;
  for (std::size_t s = 0; s < 4; ++s) {
    calib::MeasuredTest& test = study.specimens[s].test;
    const double error = s < 2 ? 0.07 : 0.04;
    test = straight_test(test.modulus, test.strength * std::exp(error * normal(random)),
                         truth.modulus_error, truth.strength_error + error);
  }
  return study;
}

inline calib::CalibrationResult fit(const calib::Study& study, const ClosedForm& law = {}) {
  return calib::calibrate_with(law.simulator(), study);
}

/// The parameter of that name; an empty one if there is none.
template <class Result>
auto parameter_of(const Result& result, const std::string& name) {
  const auto found = std::find_if(result.parameters.begin(), result.parameters.end(),
                                  [&](const auto& p) { return p.name == name; });
  return found == result.parameters.end() ? typename std::decay_t<decltype(*found)>{} : *found;
}

/// A fitted parameter that the specimens tell, within a part of its truth.
inline void expect_within(const calib::CalibratedParameter& parameter, double truth, double part) {
  EXPECT_TRUE(parameter.identifiable) << parameter.name;
  EXPECT_NEAR(parameter.value, truth, part * truth) << parameter.name;
}

/// The check of that name; an empty one, and a failure, if there is none.
inline calib::Check check_of(const calib::CalibrationResult& result, const std::string& name) {
  for (const auto& check : result.verdict)
    if (check.check == name) return check;
  ADD_FAILURE() << "no check " << name;
  return {};
}

inline bool says(const calib::Check& check, const std::string& words) {
  return check.text.find(words) != std::string::npos;
}

}  // namespace havers::test
