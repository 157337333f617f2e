// The modulus of a curve: where it is straight, and how steep.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "calib/experiment/measured_test.hpp"
#include "calib/experiment/robust_line.hpp"

namespace havers::calib {

/// Rows [first, last) of a curve.
struct RowRange {
  std::size_t first = 0, last = 0;

  /// 0 where the range ends before it begins.
  [[nodiscard]] std::size_t rows() const { return last > first ? last - first : 0; }
};

struct ModulusFit {
  Line line;        ///< Stress over strain. `fitted` false: no modulus can be had.
  RowRange window;  ///< Rows that the line was fitted to.
  std::vector<Correction> corrections;  ///< "modulus window", where it was narrowed or moved.
  std::vector<std::string> warnings;    ///< A sentence each.
};

/// Fits the modulus to a curve up to its largest stress (X3)-(X6), (X24). Strain [-], stress [Pa],
/// strength [Pa]. Where the window's rows are too few, or all of one strain, the line is not
/// fitted.
ModulusFit fit_modulus(std::span<const double> strain, std::span<const double> stress,
                       double strength, const ReductionOptions& options);

}  // namespace havers::calib
