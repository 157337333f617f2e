// What columns without names may hold.
#pragma once

#include <string>

#include "io/machine/layout.hpp"

namespace havers::io {

/// A guess from the numbers, as the user would write it: `time = "1", force = "3", extension =
/// "2"`. Time increases from row to row in even steps, force has the largest range of the others.
std::string guess_columns(const Preview& preview, const Table& table);

}  // namespace havers::io
