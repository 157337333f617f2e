// What a study says and can hardly mean: keys that change nothing, starts that cannot be.
#pragma once

#include <string>
#include <vector>

#include "io/config/read_study.hpp"
#include "io/config/table_reader.hpp"

namespace havers::io {

/// A sentence for each doubt about a study whose tables are read. They are warnings, as the study
/// can be fitted all the same. `top` tells which keys the file has and `read` their values: whether
/// a value was written or is a default cannot be seen from `read`.
std::vector<std::string> study_doubts(TableReader top, const StudyFile& read);

}  // namespace havers::io
