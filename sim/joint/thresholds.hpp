// Thresholds of the joints: mean forces and their scatter. Section 4 of sim/README.md.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/assembly/assembly.hpp"
#include "sim/scene.hpp"

namespace havers::sim {

/// A number in (0, 1), both ends excluded, from 64 random bits.
double open_uniform(std::uint64_t bits);

/// Factors w of mean 1 and standard deviation d/√12 (M8), each a function of (seed, joint) alone:
/// parameters stretch the draw but never reshuffle it. [-]
class ThresholdFactors {
 public:
  /// @param scatter  d, in [0, 2); 0: all factors are 1. [-]
  ThresholdFactors(std::uint64_t seed, double scatter, Distribution distribution);
  /// w of the joint of that index.
  [[nodiscard]] double operator()(std::uint64_t joint) const;

 private:
  std::uint64_t seed_;
  double scatter_;
  Distribution distribution_;
  double shape_ = 0.0;  // k of the Weibull law, or the deviation of ln w
};

/// Whether pores have taken the joint away (M13), a function of (seed, joint) alone and drawn apart
/// from its thresholds: what is missing at one fraction is missing at every larger one.
bool is_drawn_missing(std::uint64_t seed, std::uint64_t joint, double fraction);

/// σ₁: the scene's or, where it gives thresholds, that by the median of their ratios to the scene's
/// mean ones over the head-tail joints. [Pa]
double head_tail_strength(const Scene& scene);

/// Mean thresholds of a joint, in proportion to its length, with the reinforced boundary. [N/m]
Threshold mean_threshold(const Scene& scene, const Joint& joint);

/// One per joint: the scene's own where it gives them, else drawn; 0 where a joint is missing.
/// [N/m]
std::vector<Threshold> draw_thresholds(const Scene& scene, const Assembly& assembly);

}  // namespace havers::sim
