// A gauge that came late or was lost on the way, with nothing in the record there.
#pragma once

#include <string>

#include "calib/experiment/raw_test.hpp"

namespace havers::calib {

/// Where the strain is no number at the record's beginning or end it goes on with the crosshead
/// (X14); after the largest load, without a crosshead, it stays. A strain that holds no number at
/// all is dropped; a logger's record, without a load, is cut to its readings. Returns why it cannot
/// be done, or nothing.
std::string mend_lost_gauge(RawTest& raw);

}  // namespace havers::calib
