// Which name was meant by one that is not known.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace havers::io {

/// "did you mean X?" of the candidate with the fewest letters to insert, drop or replace; none
/// where these are more than about a third of the word without its dashes, unless it lacks only the
/// unit: "width" of "width_mm".
std::string did_you_mean(std::string_view word,
                         const std::set<std::string, std::less<>>& candidates);

/// The same; "known are X, Y, Z" where none is near, and nothing where there are no candidates.
std::string nearest_or_all(std::string_view word,
                           const std::set<std::string, std::less<>>& candidates);

}  // namespace havers::io
