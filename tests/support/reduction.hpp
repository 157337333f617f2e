// Reduction of tests that must succeed, and what it says of its corrections.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "calib/experiment/measured_test.hpp"

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

}  // namespace havers::test
