// How well common practice and havers measure porosity, on drawn sections of known porosity.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace havers::calib {

/// Ways to measure the porosity of an image. The number of a method is its place in all arrays
/// here.
enum class PorosityMethod {
  naive,         ///< Darker than the middle of the grey scale, over the whole image.
  otsu,          ///< Otsu's threshold of the whole image, over the whole image.
  otsu_in_mask,  ///< Otsu's threshold of the bone's pixels, over the bone.
  ours,          ///< What `havers porosity` does.
};
constexpr std::size_t porosity_methods = 4;
/// For tables and figures.
std::string to_string(PorosityMethod method);

/// What one method gives for one image.
struct PorosityReading {
  double porosity = 0.0;  ///< [-]
  double cpu = 0.0;       ///< From the file to the number. [s]
};

/// One drawn section, measured in every way.
struct PorosityTrial {
  std::string hardship;  ///< What makes it hard: "noise", "cupping", ...
  bool ring = false;     ///< With a marrow cavity; otherwise a machined bar.
  double pixels = 0.0;   ///< Of the image. [px]
  double truth = 0.0;    ///< Drawn porosity. [-]
  std::array<PorosityReading, porosity_methods> readings;  ///< In the order of PorosityMethod.
  double standard_error = 0.0;                             ///< Of the last of them. [-]

  /// |porosity − truth|. [-]
  [[nodiscard]] double error(PorosityMethod method) const;
};

/// A method over some trials.
struct MethodSummary {
  PorosityMethod method = PorosityMethod::naive;
  double median_error = 0.0;   ///< [-]
  double worst_error = 0.0;    ///< [-]
  double worst_if_none = 0.0;  ///< On sections without pores; NaN: there are none. [-]
  double cpu_per_pixel = 0.0;  ///< Of all trials together. [s]
};

/// Every method over the trials with one hardship.
struct HardshipSummary {
  std::string hardship;
  std::array<MethodSummary, porosity_methods> methods;
};

/// What `havers bench --porosity` shows.
struct MethodComparison {
  std::vector<PorosityTrial> trials;
  std::array<MethodSummary, porosity_methods> methods;  ///< Over all trials.
  std::vector<HardshipSummary> hardships;               ///< In the order of the trials.
  bool complete = true;                                 ///< Every section was measured.

  /// Whether ours errs by 0.3 points of porosity at most, and 0.05 where there are no pores.
  [[nodiscard]] bool good() const {
    return methods.back().worst_error <= 0.003 && !(methods.back().worst_if_none > 0.0005);
  }
};

/// Precondition: at least one trial.
MethodComparison compare_methods(std::vector<PorosityTrial> trials);

}  // namespace havers::calib
