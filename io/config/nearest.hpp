#pragma once

#include <set>
#include <string>
#include <string_view>

namespace havers::io {

/// The candidate with the fewest letters to insert, drop or replace; empty when there is
/// none.
std::string nearest(std::string_view word, const std::set<std::string, std::less<>>& candidates);

}  // namespace havers::io
