// What a study says and can hardly mean: keys that change nothing, starts that cannot be.
#pragma once

#include <string>
#include <vector>

#include "io/config/read_study.hpp"
#include "io/config/table_reader.hpp"

namespace havers::io {

/// A sentence each, of a study whose tables are read; a warning, for the study can be fitted all
/// the same. `top` tells what the file says and `read` what became of it: a key that states a
/// default is in the one and not to be seen in the other.
std::vector<std::string> study_doubts(TableReader top, const StudyFile& read);

}  // namespace havers::io
