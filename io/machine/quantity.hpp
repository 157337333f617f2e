// What is known of each quantity that a column may hold.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "io/machine/read_test.hpp"
#include "io/machine/units.hpp"

namespace havers::io {

struct QuantityInfo {
  std::string_view name;
  std::vector<double> calib::RawTest::*channel;  ///< Null for none.
  std::optional<Dimension> dimension;
  std::string_view assumed_unit;  ///< Where none is written.
  std::string_view usual_units;   ///< Those that are met most; more are known.
};
const QuantityInfo& info_of(Quantity quantity);

/// A unit that the quantity can have. A gauge may be recorded as an elongation.
bool fits(Quantity quantity, Dimension dimension);

/// What the column's unit measures, where that is known.
std::optional<Dimension> dimension_of(const Column& column);

}  // namespace havers::io
