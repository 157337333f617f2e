// What is wrong with single rows of a record, put right.
#pragma once

#include "calib/experiment/measured_test.hpp"

namespace havers::calib {

/// Replaces rows that stand out of their four neighbours by the mean of the two next (X11). The
/// number of rows.
std::size_t remove_spikes(std::vector<double>& values);

/// Gives rows that share a time times of their own, evenly up to the next (X12). The number of
/// rows. [s]
std::size_t spread_repeated_times(std::vector<double>& time);

/// Both on all channels, as far as the options want it; what was done is listed in the test.
void clean_channels(RawTest& test, const ReductionOptions& options);

}  // namespace havers::calib
