// What the user should know of how columns were chosen.
#pragma once

#include <string>

#include "io/machine/column_hints.hpp"
#include "io/machine/read_test.hpp"

namespace havers::io {

/// Warns of columns taken in doubt or by their unit alone, of names and units that contradict each
/// other, of what may be a strain and is not read, of units that are not known. @throws InputError
/// when the load is lost by such a unit.
void note_columns(TestFile& file, const std::string& where, const ReadOptions& options,
                  const Chosen& chosen);

}  // namespace havers::io
