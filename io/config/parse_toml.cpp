// The file and each override become tables of their own, merged key by key. Every node keeps the
// source that it was parsed from, so that a complaint about it names its line or its --set.
#include "io/config/parse_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "io/input_error.hpp"
#include "io/read_text.hpp"

namespace havers::io {
namespace {

// What is behind the parser's most frequent complaints, known by some of their words; empty for
// others. The first that fits counts, so the more special of two stands first.
const char* hint_for(std::string_view complaint) {
  using Hint = std::pair<std::string_view, const char*>;
  for (const auto& [words, hint] :
       {Hint{"saw ','", "write numbers with a point, 4.02"},
        Hint{"existing table 'specimen'",
             "write [[specimen]], with two brackets, for each of several"},
        Hint{"existing table", "put all keys of a table below one line of its name"},
        Hint{"redefine existing", "each key stands once in its table"},
        Hint{"escape sequence", R"(write folders with /, as in "data/A1.csv")"},
        Hint{"scalar sequence", R"(write folders with /, as in "data/A1.csv")"},
        Hint{"a comment or whitespace", "a key has one value, without a unit"},
        Hint{"control characters", "close the text with the quote that opens it"},
        Hint{"floating-point", "write digits on both sides of the point, 13.0"},
        Hint{"utf-8", "save the file as UTF-8"},
        Hint{"determine value type", R"(write texts in straight quotes, as in "weibull")"},
        Hint{"parsing boolean", "write true or false in small letters"},
        Hint{"64 bits", "write it with fewer digits"}})
    if (complaint.find(words) != std::string_view::npos) return hint;
  return "";
}

toml::table parse_file(const std::filesystem::path& file) {
  const std::string text = read_text(file, "a TOML file is expected there");
  try {
    toml::table table = toml::parse(text, file.string());
    if (table.empty())
      throw InputError(file.string(), "is empty", "a study, scene or sweep is expected there");
    return table;
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw InputError(
        fmt::format("{}:{}:{}", file.string(), at.line, at.column),
        fmt::format("is not TOML: {}", error.description()),
        file.extension() == ".toml"
            ? hint_for(error.description())
            : "a study, scene or sweep is; havers import reads tests, havers porosity images");
  }
}

// TOML's whole numbers have 64 bits with their sign; a longer one would pass for a bare word.
bool has_too_many_digits(std::string_view text) {
  std::int64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc::result_out_of_range && read.ptr == text.data() + text.size();
}

// "joints.scatter=0.3" as a table; its nodes name "--set joints.scatter" as their source.
toml::table parse_override(const std::string& text) {
  // Without a "=" the whole text is the key.
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const std::string source = std::string(override_mark) + key;
  if (text.find_first_not_of(" \t", std::min(equals, text.size() - 1) + 1) == std::string::npos)
    throw InputError(source, "has no value", "write --set joints.scatter=0.3");
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error&) {
    // Not a TOML value, so perhaps a bare word: the shell has eaten its quotes, if it ever had any.
  }
  const std::string value = text.substr(equals + 1);
  if (has_too_many_digits(value))
    throw InputError(source, fmt::format("is {}, must be at most 2^63 - 1", value));
  try {
    // A literal text: no backslash in it is an escape.
    return toml::parse(fmt::format("{} = '{}'", key, value), source);
  } catch (const toml::parse_error& error) {
    throw InputError(source, fmt::format("is not TOML: {}", error.description()),
                     "write --set joints.scatter=0.3");
  }
}

// Puts `overrides` on top: tables of one name are joined, anything else is replaced. A later
// override wins.
void merge(toml::table& top, toml::table&& overrides) {
  std::vector<std::pair<toml::table*, toml::table*>> pairs{{&top, &overrides}};
  while (!pairs.empty()) {
    const auto [into, from] = pairs.back();
    pairs.pop_back();
    for (auto&& [key, node] : *from) {
      toml::node* const present = into->get(key);
      if (node.is_table() && present != nullptr && present->is_table())
        pairs.emplace_back(present->as_table(), node.as_table());
      else  // moved, not copied: only a move keeps the source
        node.visit([table = into, &name = key](auto& value) {
          table->insert_or_assign(name, std::move(value));
        });
    }
  }
}

}  // namespace

bool is_override(const toml::node& node) {
  const toml::source_region& source = node.source();
  return source.path && source.path->starts_with(override_mark);
}

toml::table parse_toml(const std::filesystem::path& file, const Overrides& overrides) {
  toml::table table = file.empty() ? toml::table{} : parse_file(file);
  // A faulty file ends the reading; of the overrides all are tried, to name every faulty one.
  std::vector<Problem> problems;
  for (const std::string& text : overrides) {
    try {
      merge(table, parse_override(text));
    } catch (const InputError& error) {
      collect(problems, error.problems());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return table;
}

}  // namespace havers::io
