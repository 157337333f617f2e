// Thresholds of joints (section 4). Random numbers are a function of a counter, not of what was
// drawn before [SMDS11], so that each joint's is known by itself; distributions are inverted, so
// that one quantile serves all of them.
#include "sim/joint/thresholds.hpp"

#include <Random123/philox.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace havers::sim {
namespace {

// What a number is drawn for: draws for one say nothing of draws for the other.
enum class Stream : std::uint64_t { factor, missing };

// Of one joint, whatever was drawn before. [SMDS11]
double uniform(std::uint64_t seed, std::uint64_t joint, Stream stream) {
  const r123::Philox2x64::ctr_type counter{{joint, static_cast<std::uint64_t>(stream)}};
  const r123::Philox2x64::key_type key{{seed}};
  return open_uniform(r123::Philox2x64()(counter, key)[0]);
}

// Shape k of the Weibull law whose coefficient of variation is `cv`: Γ(1+2/k)/Γ(1+1/k)² = 1 + cv².
double weibull_shape(double cv) {
  const auto excess = [&](double k) {
    return std::lgamma(1.0 + 2.0 / k) - 2.0 * std::lgamma(1.0 + 1.0 / k) - std::log1p(cv * cv);
  };
  // The coefficient of variation falls as k rises: bisection on a logarithmic scale.
  double low = 0.1, high = 1e7;  // cv from 400 to 1e-7
  for (int i = 0; i < 200 && high / low > 1.0 + 1e-15; ++i) {
    const double middle = std::sqrt(low * high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// The specimen's sides along which the joint's layer lies: of one layer both.
int outer_sides(const Scene& scene, const Joint& joint) {
  const double height = scene.assembly.fibre_height, y = joint.position.y();
  return (y < height ? 1 : 0) + (y > scene.assembly.height() - height ? 1 : 0);
}

}  // namespace

// The largest of these numbers would be rounded to 1.
double open_uniform(std::uint64_t bits) {
  return std::min((static_cast<double>(bits >> 11) + 0.5) * 0x1p-53, 1.0 - 0x1p-53);
}

ThresholdFactors::ThresholdFactors(std::uint64_t seed, double scatter, Distribution distribution)
    : seed_(seed), scatter_(scatter), distribution_(distribution) {
  const double cv = scatter / std::sqrt(12.0);
  // A log-normal variable of mean 1, whose logarithm has deviation s, has variance e^(s²) − 1.
  if (distribution == Distribution::lognormal) shape_ = std::sqrt(std::log1p(cv * cv));
  if (distribution == Distribution::weibull && scatter > 0.0) shape_ = weibull_shape(cv);
}

double ThresholdFactors::operator()(std::uint64_t joint) const {
  if (scatter_ == 0.0) return 1.0;
  const double u = uniform(seed_, joint, Stream::factor);
  switch (distribution_) {
    case Distribution::uniform:
      return 1.0 + scatter_ * (u - 0.5);
    case Distribution::lognormal:
      return std::exp(shape_ * gsl_cdf_ugaussian_Pinv(u) - 0.5 * shape_ * shape_);
    case Distribution::weibull:
      // Divided by its mean Γ(1 + 1/k).
      return std::exp(std::log(-std::log1p(-u)) / shape_ - std::lgamma(1.0 + 1.0 / shape_));
  }
  return 1.0;
}

bool is_drawn_missing(std::uint64_t seed, std::uint64_t joint, double fraction) {
  return uniform(seed, joint, Stream::missing) < fraction;
}

double head_tail_strength(const Scene& scene) {
  const std::vector<Threshold>& given = scene.joints.thresholds;
  if (given.empty()) return scene.joints.head_tail;
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  std::vector<double> factors;
  // Thresholds of another wall are refused, but this may be called before that.
  for (std::size_t j = 0; j < std::min(given.size(), assembly.joints.size()); ++j)
    if (const Joint& joint = assembly.joints[j];
        joint.kind == JointKind::head_tail && !is_missing(given[j]))
      factors.push_back(given[j].normal / mean_threshold(scene, joint).normal);
  if (factors.empty()) return scene.joints.head_tail;
  return gsl_stats_median(factors.data(), 1, factors.size()) * scene.joints.head_tail;
}

Threshold mean_threshold(const Scene& scene, const Joint& joint) {
  const JointOptions& j = scene.joints;
  const double height = scene.assembly.fibre_height, half = 0.5 * scene.assembly.fibre_length;
  const double f1 = j.head_tail * height, f2 = j.flank * half;
  const bool head_tail = joint.kind == JointKind::head_tail;

  // By default both kinds of joints have the same pair.
  Threshold full{f1, f2};
  if (head_tail && j.head_tail_shear) full.tangent = *j.head_tail_shear * height;
  if (!head_tail && j.flank_tension) full.normal = *j.flank_tension * half;
  // The outer layers also carry the flanks whose neighbours are not modelled.
  if (head_tail && reinforced_boundary(scene)) full.normal += outer_sides(scene, joint) * f2;

  const double part = joint.length / (head_tail ? height : half);
  return {full.normal * part, full.tangent * part};
}

std::vector<Threshold> draw_thresholds(const Scene& scene, const Assembly& assembly) {
  assert(scene.joints.thresholds.empty() ||
         scene.joints.thresholds.size() == assembly.joints.size());
  const JointOptions& joints = scene.joints;
  if (!joints.thresholds.empty()) return joints.thresholds;
  // Missing joints keep thresholds of 0.
  const ThresholdFactors factor(joints.seed, joints.scatter, joints.distribution);
  std::vector<Threshold> thresholds(assembly.joints.size());
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    if (is_drawn_missing(joints.seed, i, joints.missing)) continue;
    const Threshold mean = mean_threshold(scene, assembly.joints[i]);
    const double w = factor(i);
    thresholds[i] = {mean.normal * w, mean.tangent * w};
  }
  return thresholds;
}

}  // namespace havers::sim
