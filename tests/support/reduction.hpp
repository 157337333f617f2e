// Reduction of tests that must succeed, and what it says of its corrections.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"

namespace havers::test {

inline std::string detail_of(const calib::MeasuredTest& test, const std::string& what) {
  for (const calib::Correction& correction : test.corrections)
    if (correction.what == what) return correction.detail;
  return {};
}

inline calib::MeasuredTest reduced(const calib::RawTest& raw,
                                   const calib::ReductionOptions& options = {}) {
  const calib::Reduction reduction = reduce_test(raw, options);
  EXPECT_TRUE(reduction.problems.empty()) << reduction.problems.front();
  return reduction.test;
}

/// Modulus, strength and failure strain of the specimen that was recorded.
inline void expect_the_truth(const calib::MeasuredTest& test, const TensileTruth& truth,
                             double tolerance) {
  EXPECT_NEAR(test.modulus, truth.young, tolerance * truth.young);
  EXPECT_NEAR(test.strength, truth.strength, tolerance * truth.strength);
  EXPECT_NEAR(test.failure_strain, truth.failure_strain(), tolerance * truth.failure_strain());
}

}  // namespace havers::test
