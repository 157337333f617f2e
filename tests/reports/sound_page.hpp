// What every page must be: well formed, and whole without other files.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/results.hpp"

namespace havers::test {

/// What stands between each `before` and the next of `ends`.
inline std::vector<std::string> after(const std::string& text, std::string_view before,
                                      std::string_view ends) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
    at += before.size();
    found.push_back(text.substr(at, text.find_first_of(ends, at) - at));
  }
  return found;
}

/// The rows of all tables of a page as a reader sees them: "E|13.1 ± 0.2|GPa". Pictures are left
/// out, and spaces that do not break are plain ones.
inline std::vector<std::string> table_rows(const std::string& page) {
  static const std::string begin = "<tr", end = "</tr>", svg = "</svg>";
  std::vector<std::string> rows;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    const std::size_t last = page.find(end, at);
    std::string& row = rows.emplace_back();
    while (at < last) {
      if (page.compare(at, 4, "<svg") == 0) {
        at = page.find(svg, at) + svg.size();
      } else if (page[at] == '<') {
        const std::string tag = page.substr(at, page.find('>', at) + 1 - at);
        if (tag == "</td>" || tag == "</th>") row += '|';
        at += tag.size();
      } else {
        const bool held = page.compare(at, 2, "\u00a0") == 0;
        if (page[at] != '\n') row += held ? ' ' : page[at];
        at += held ? 2 : 1;
      }
    }
    if (!row.empty()) row.pop_back();
  }
  return rows;
}

inline std::vector<std::string> attributes(const std::string& page, const std::string& name) {
  std::vector<std::string> found = after(page, name + "=\"", "\"");
  for (std::string& value : after(page, name + "='", "'")) found.push_back(std::move(value));
  return found;
}

/// Every start tag has its end tag in the right order; void elements and self-closed ones aside.
inline void expect_balanced(const std::string& page) {
  static const std::set<std::string> alone{"meta", "img", "br"};
  std::vector<std::string> open;
  for (const std::string& tag : after(page, "<", ">")) {
    const bool ends = tag.starts_with('/');
    const std::string name =
        tag.substr(ends ? 1 : 0, tag.find_first_of(" \n/", 1) - (ends ? 1 : 0));
    if (alone.contains(name) || tag.ends_with('/') || tag.starts_with('!') || tag.starts_with('?'))
      continue;
    if (!ends) {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty()) << "</" << name << "> closes nothing";
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

inline void expect_self_contained(const std::string& page) {
  EXPECT_FALSE(contains(page, "<script"));
  EXPECT_FALSE(contains(page, "<link"));
  EXPECT_FALSE(contains(page, "@import"));
  for (const char* name : {"src", "href"})
    for (const std::string& source : attributes(page, name))
      EXPECT_TRUE(source.starts_with("data:image/") || source.starts_with("#"))
          << source.substr(0, 20);
}

inline void expect_unique_ids(const std::string& page) {
  std::map<std::string, int> uses;
  for (const std::string& id : attributes(page, " id")) ++uses[id];
  for (const auto& [id, n] : uses) EXPECT_EQ(n, 1) << id;
  for (const char* reference : {"href=\"#", "href='#", "url(#"})
    for (const std::string& target : after(page, reference, "\"')"))
      EXPECT_TRUE(uses.contains(target)) << target;
}

inline void expect_sound(const std::string& page) {
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_FALSE(contains(page, "{{"));
  EXPECT_FALSE(contains(page, ">nan"));
  expect_balanced(page);
  expect_self_contained(page);
  expect_unique_ids(page);
}

}  // namespace havers::test
