#include "io/config/nearest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace havers::io {
namespace {

// Levenshtein's distance with one row of its table kept.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (letter == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view word,
                         const std::set<std::string, std::less<>>& candidates) {
  const auto closer = [&](const std::string& a, const std::string& b) {
    return distance(word, a) < distance(word, b);
  };
  const auto found = std::ranges::min_element(candidates, closer);
  if (found != candidates.end() &&
      3 * distance(word, *found) <= 2 + std::max(word.size(), found->size()))
    return fmt::format("did you mean {}?", *found);
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
