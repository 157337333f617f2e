// Words of a file as a message quotes them.
#pragma once

#include <string>
#include <string_view>

namespace havers::io {

/// The beginning of a text from a file, short enough for a sentence: a cell may be megabytes long.
/// Control characters become blanks; what is left out is shown by "...".
std::string excerpt(std::string_view text);

}  // namespace havers::io
