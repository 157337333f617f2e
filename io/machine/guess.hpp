// What columns without names may hold.
#pragma once

#include <string>

#include "io/machine/layout.hpp"

namespace havers::io {

/// A guess from the numbers, as the user would write it: `time = "1", force = "3", extension =
/// "2"`. Of three columns or more, the first that increases in even steps is time; force has the
/// largest range of the others.
std::string guess_columns(const Preview& preview, const Table& table);

}  // namespace havers::io
