// What is known of each quantity that a column may hold.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "io/machine/read_test.hpp"
#include "io/machine/units.hpp"

namespace havers::io {

/// A quantity's place in a test and its units.
struct QuantityInfo {
  std::string_view name;                         ///< As in keys and messages.
  std::vector<double> calib::RawTest::*channel;  ///< Of a test; null for none.
  std::optional<Dimension> dimension;            ///< Of its unit; none for `other`.
  std::string_view assumed_unit;                 ///< Where none is written.
  std::string_view usual_units;                  ///< Those that are met most; more are known.
};
/// What is known of a quantity; the reference stays valid.
const QuantityInfo& info_of(Quantity quantity);

/// A unit that the quantity can have. A gauge may be recorded as an elongation.
bool fits(Quantity quantity, Dimension dimension);

/// What the column's unit measures; nothing where it has none, or one that is not known.
std::optional<Dimension> dimension_of(const Column& column);

}  // namespace havers::io
