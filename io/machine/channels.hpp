// Which columns of a table are the channels of a test.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/machine/layout.hpp"
#include "io/machine/read_test.hpp"

namespace havers::io {

/// A column that is read.
struct Channel {
  Quantity quantity = Quantity::other;
  std::size_t column = 0;     ///< Of the row, from 0.
  std::size_t in_file = 0;    ///< Of the specimen's columns, from 0.
  double to_si = 1.0;         ///< Factor to s, N, m, 1, Pa or V.
  bool second_gauge = false;  ///< Of two alike, as on two faces of a bar.
};

/// The warning of a column that names no unit.
std::string without_unit(const Column& column, std::string_view assumed);

/// Finds the channels by the user's hint, by the name, by the unit. `test` gives the gauge length
/// (a gauge may be recorded in mm) and takes the warnings. `columns` gets every column's quantity.
/// @throws InputError, for the line of the names, when a hint names no column or nothing measures
/// the load, or, in a logger's file, time and a gauge. The second of two gauges that are alike
/// comes last.
std::vector<Channel> find_channels(TestFile& file, const Table& table, const ReadOptions& options);

}  // namespace havers::io
