#include "io/config/nearest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace havers::io {
namespace {

// Levenshtein's distance, in which two letters that changed places are one slip. of[i][j] is the
// distance of the first i letters of a to the first j of b.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> of(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        of[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = of[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      of[i][j] = std::min({replaced, of[i - 1][j] + 1, of[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        of[i][j] = std::min(of[i][j], of[i - 2][j - 2] + 1);
    }
  return of[a.size()][b.size()];
}

// The dashes of an option are no part of its name.
std::size_t letters(std::string_view word) {
  return word.size() - std::min(word.find_first_not_of('-'), word.size());
}

}  // namespace

std::string did_you_mean(std::string_view word,
                         const std::set<std::string, std::less<>>& candidates) {
  const auto closer = [&](const std::string& a, const std::string& b) {
    return distance(word, a) < distance(word, b);
  };
  // Of two as near it is the first in the alphabet, as the set is sorted.
  const auto found = std::ranges::min_element(candidates, closer);
  if (found != candidates.end() &&
      // (n + 2)/3 slips in n letters: one in a word of up to three.
      3 * distance(word, *found) <= 2 + std::max(letters(word), letters(*found)))
    return fmt::format("did you mean {}?", *found);
  // A key without its unit lacks too many letters for a slip, but it is plain which one is meant.
  const auto without_unit = [&](const std::string& key) {
    return key.starts_with(std::string(word) + "_");
  };
  const auto longer = std::ranges::find_if(candidates, without_unit);
  return longer == candidates.end() ? "" : fmt::format("did you mean {}?", *longer);
}

std::string nearest_or_all(std::string_view word,
                           const std::set<std::string, std::less<>>& candidates) {
  std::string hint = did_you_mean(word, candidates);
  if (hint.empty() && !candidates.empty())
    hint = fmt::format("known are {}", fmt::join(candidates, ", "));
  return hint;
}

}  // namespace havers::io
