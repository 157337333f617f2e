// Every `key` first notes that it was asked for, then looks it up: a key of the file that nobody
// asked for is unknown in the end. Types are TOML's own; text is never taken for a number.
#include "io/config/table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/config/nearest.hpp"
#include "io/config/parse_toml.hpp"

namespace havers::io {
namespace {

// Beyond what a laboratory or a model can mean, and far within what can be computed.
constexpr double largest_number = 1e30, smallest_number = 1e-30;
constexpr std::int64_t largest_count = 1'000'000'000;  // of anything that is counted

std::string_view kind(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_number()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "a list";
  return node.is_table() ? "a table" : "a date or time";
}

// What a dotted key names, or the innermost table on the way that is there.
const toml::node& innermost(const toml::table& table, std::string_view key) {
  const toml::node* node = &table;
  while (!key.empty() && node->is_table()) {
    const std::size_t end = std::min(key.find('.'), key.size());
    const toml::node* inner = node->as_table()->get(key.substr(0, end));
    if (inner == nullptr) break;
    node = inner;
    key.remove_prefix(std::min(end + 1, key.size()));
  }
  return *node;
}

}  // namespace

std::string dotted(const std::string& path, std::string_view name) {
  if (path.empty() || name.empty()) return path + std::string(name);
  return fmt::format("{}.{}", path, name);
}

std::string TableReader::full(std::string_view name) const {
  return dotted(path_, name);
}

bool TableReader::has(std::string_view name) const {
  return table_ != nullptr && table_->contains(name);
}

bool TableReader::is_text(std::string_view name) const {
  return has(name) && table_->get(name)->is_string();
}

bool TableReader::is_name_or_number(std::string_view name) {
  const toml::node* node = ask(name);
  if (node == nullptr || node->is_string() || node->is_number()) return true;
  return wrong_type(name, *node, "a text, its name, or a whole number, which it is");
}

const toml::node* TableReader::ask(std::string_view name) {
  file_->asked_[path_].emplace(name);  // also where the key is absent
  return table_ == nullptr ? nullptr : table_->get(name);
}

void TableReader::complain(std::string_view name, std::string what, std::string hint) {
  const toml::node& node =
      table_ != nullptr ? innermost(*table_, name) : innermost(*file_->top_, full(name));
  file_->complain({file_->where(node, full(name)), std::move(what), std::move(hint)});
}

void TableReader::complain(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) file_->complain(problem);
}

void TableReader::require(bool holds, std::string_view name, double value, std::string_view rule) {
  if (!holds) complain(name, fmt::format("is {:g}, must be {}", value, rule));
}

bool TableReader::wrong_type(std::string_view name, const toml::node& node,
                             std::string_view expected) {
  complain(name, fmt::format("is {}, must be {}", kind(node), expected));
  return false;
}

// TOML's own conversion refuses whole numbers that a double only rounds.
std::optional<double> TableReader::usable_number(std::string_view name, const toml::node& node) {
  const double number =
      node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
  const double size = std::abs(number);
  if (!std::isfinite(number))
    complain(name, fmt::format("is {}, must be finite", number));
  else if (size > largest_number)
    complain(name, fmt::format("is {:g}, must be at most {:g} in size", number, largest_number));
  else if (size > 0.0 && size < smallest_number)
    complain(name,
             fmt::format("is {:g}, must be 0 or at least {:g} in size", number, smallest_number));
  else
    return number;
  return std::nullopt;
}

bool TableReader::key(std::string_view name, double& value, KeyUnit unit) {
  const toml::node* node = ask(name);
  if (node == nullptr) return false;
  if (!node->is_number()) return wrong_type(name, *node, "a number");
  const std::optional<double> number = usable_number(name, *node);
  if (number) value = to_si(*number, unit);
  return number.has_value();
}

template <class T>
bool TableReader::take(std::string_view name, T& value, std::string_view expected) {
  const toml::node* node = ask(name);
  if (node == nullptr) return false;
  if (!node->is<T>()) return wrong_type(name, *node, expected);
  value = **node->as<T>();
  return true;
}

std::optional<std::int64_t> TableReader::whole_number(std::string_view name) {
  const toml::node* node = ask(name);
  if (node == nullptr) return std::nullopt;
  const std::optional<std::int64_t> number = node->value_exact<std::int64_t>();
  if (!number && node->is_number())
    complain(name, fmt::format("is {:#}, must be a whole number", *node->value<double>()));
  else if (!number)
    wrong_type(name, *node, "a whole number");
  return number;
}

bool TableReader::key(std::string_view name, int& value) {
  const std::optional<std::int64_t> number = whole_number(name);
  if (!number) return false;
  if (*number < -largest_count || *number > largest_count) {
    complain(name, fmt::format("is {}, must be at most {} in size", *number, largest_count));
    return false;
  }
  value = static_cast<int>(*number);
  return true;
}

bool TableReader::key(std::string_view name, std::uint64_t& value) {
  const std::optional<std::int64_t> number = whole_number(name);
  if (number && *number < 0) complain(name, fmt::format("is {}, must be 0 or more", *number));
  if (!number || *number < 0) return false;
  value = static_cast<std::uint64_t>(*number);
  return true;
}

bool TableReader::key(std::string_view name, bool& value) {
  return take(name, value, "true or false");
}

bool TableReader::key(std::string_view name, std::string& value) {
  return take(name, value, "a text");
}

bool TableReader::key(std::string_view name, std::pair<double, double>& value) {
  const toml::node* node = ask(name);
  if (node == nullptr) return false;
  const toml::array* list = node->as_array();
  const auto is_number = [](const toml::node& item) { return item.is_number(); };
  if (list == nullptr || list->size() != 2 || !std::all_of(list->begin(), list->end(), is_number)) {
    complain(name, "must be a list of two numbers", "as in [5.0, 30.0]");
    return false;
  }
  const std::optional<double> first = usable_number(name, *list->get(0));
  const std::optional<double> second = usable_number(name, *list->get(1));
  if (first && second) value = {*first, *second};
  return first && second;
}

bool TableReader::key(std::string_view name, std::vector<std::string>& value) {
  const toml::node* node = ask(name);
  if (node == nullptr) return false;
  const toml::array* list = node->as_array();
  const auto is_text = [](const toml::node& item) { return item.is_string(); };
  if (list == nullptr || !std::all_of(list->begin(), list->end(), is_text))
    return wrong_type(name, *node, "a list of texts");
  value.clear();
  for (const toml::node& item : *list) value.push_back(**item.as_string());
  return true;
}

bool TableReader::key(std::string_view name, std::filesystem::path& value) {
  std::string text;
  if (!key(name, text)) return false;
  value = file_->beside(text);
  return true;
}

bool TableReader::key(std::string_view name, std::vector<std::filesystem::path>& value) {
  std::vector<std::string> texts;
  if (!key(name, texts)) return false;
  value.clear();
  for (const std::string& text : texts) value.push_back(file_->beside(text));
  return true;
}

bool TableReader::require_file(std::string_view name, const std::filesystem::path& file) {
  std::error_code error;  // of a name that is too long, or a folder that is closed
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  const bool there = std::filesystem::is_regular_file(status);
  const bool named = file.has_filename();     // beside() has added nothing else to the folder
  if (there) file_->inputs_.push_back(file);  // for the provenance
  if (!named) complain(name, "is empty, must name a file");
  if (!named || there) return there;
  const bool set = is_override(innermost(*table_, name));  // by the command line
  if (!std::filesystem::status_known(status)) {
    complain(name,
             fmt::format("names {}, which cannot be read: {}", file.string(), error.message()));
    return false;
  }
  if (std::filesystem::is_directory(status)) {
    complain(name, fmt::format("names {}, which is a folder", file.string()), "name a file in it");
    return false;
  }
  complain(name, fmt::format("names {}, which is not there", file.string()),
           "paths are relative to the folder of " + (set ? file_->file_.string() : "this file"));
  return false;
}

std::optional<std::size_t> TableReader::word_index(std::string_view name,
                                                   const std::vector<std::string_view>& known) {
  std::string text;
  if (!key(name, text)) return std::nullopt;
  const auto found = std::find(known.begin(), known.end(), text);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  complain(name, fmt::format("is \"{}\", must be one of: {}", text, fmt::join(known, ", ")),
           did_you_mean(text, {known.begin(), known.end()}));
  return std::nullopt;
}

TableReader TableReader::table(std::string_view name) {
  const toml::node* node = ask(name);
  if (node != nullptr && !node->is_table()) wrong_type(name, *node, "a table");
  file_->asked_[full(name)];  // opened, even when it has no keys
  return {*file_, node == nullptr ? nullptr : node->as_table(), full(name)};
}

std::vector<TableReader> TableReader::tables(std::string_view name) {
  const toml::node* node = ask(name);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  const auto is_table = [](const toml::node& item) { return item.is_table(); };
  if (list == nullptr || list->empty() || !std::all_of(list->begin(), list->end(), is_table)) {
    complain(name, fmt::format("is {}, must be tables", kind(*node)),
             fmt::format("write [[{}]]", name));
    return {};
  }
  file_->asked_[full(name)];
  std::vector<TableReader> readers;
  for (const toml::node& item : *list) readers.emplace_back(*file_, item.as_table(), full(name));
  return readers;
}

std::vector<TableReader::List> TableReader::lists(std::string_view name) {
  const toml::node* node = ask(name);
  std::vector<List> all;
  if (node == nullptr) return all;
  if (!node->is_table()) {
    wrong_type(name, *node, "a table");
    return all;
  }
  for (auto&& [key, item] : *node->as_table()) {
    all.emplace_back(key.str(), std::vector<std::string>{});
    if (!item.is_array()) {
      complain(
          dotted(std::string(name), key.str()), fmt::format("is {}, must be a list", kind(item)),
          item.is_table() ? "quote a key with dots, as in \"joints.scatter\" = [0.2, 0.4]" : "");
      continue;
    }
    for (const toml::node& value : *item.as_array()) {
      std::ostringstream text;
      if (value.is_floating_point())  // the shortest that reads back the same
        text << fmt::format("{}", **value.as_floating_point());
      else if (value.is_integer())  // 0x10 is 16
        text << **value.as_integer();
      else
        text << toml::node_view<const toml::node>(value);
      all.back().second.push_back(text.str());
    }
  }
  return all;
}

}  // namespace havers::io
