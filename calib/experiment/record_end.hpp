// How the record of a test ends: with the break, or before it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "calib/experiment/measured_test.hpp"

namespace havers::calib {

/// What of a record counts, and whether the specimen parted at its end (X20).
struct RecordEnd {
  bool broke = false;    ///< false: stopped or unloaded before; the strength is a lower bound.
  std::size_t rows = 0;  ///< Up to the parting or the unloading; all where there is neither.
  Correction cut;        ///< What is lost with the other rows.
  std::vector<std::string> warnings;
};

/// Looks at the stress and strain of `test`, at its times where they were recorded, and at the
/// crosshead where it was recorded beside a gauge [m].
RecordEnd end_of_record(const MeasuredTest& test, std::span<const double> crosshead,
                        double break_part);

/// (X21) Where the stress jumps on its way to the largest; empty where it does not.
std::string jump_of_stress(const MeasuredTest& test);

/// (X21) Where the stress falls on its way, and the strain not with it; empty where it does not.
std::string drop_of_stress(const MeasuredTest& test);

}  // namespace havers::calib
