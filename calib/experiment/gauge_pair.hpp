// Two gauges on one bar, as on its two faces.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::calib {

/// The strain becomes the mean of `raw.strain` and `other`, called "a" and "b", which bending does
/// not move; where one has failed it is the other, and where they do not both stretch it stays
/// (X23). Returns what was done, in words.
std::string join_gauge_pair(RawTest& raw, const std::vector<double>& other, const std::string& a,
                            const std::string& b);

}  // namespace havers::calib
