// The file that table readers ask: where its keys stand, and what is wrong with them.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "io/config/nearest.hpp"
#include "io/config/parse_toml.hpp"
#include "io/config/table_reader.hpp"

namespace havers::io {

ConfigFile::ConfigFile(std::filesystem::path file, const Overrides& overrides)
    : file_(std::move(file)), top_(std::make_unique<toml::table>(parse_toml(file_, overrides))) {}

ConfigFile::~ConfigFile() = default;

TableReader ConfigFile::top() {
  return {*this, top_.get(), ""};
}

std::string ConfigFile::where(const toml::node& node, const std::string& key) const {
  // A missing key is named at the table it is missing from; the table of the whole file has no
  // line, nor has a node that was not parsed from the text.
  const toml::source_region& source = node.source();
  if (is_override(node)) return fmt::format("{}{}", override_mark, key);
  if (&node == top_.get() || source.begin.line == 0)
    return fmt::format("{}: {}", file_.string(), key);
  return fmt::format("{}:{}: {}", file_.string(), source.begin.line, key);
}

// A `..` stays, as behind a link it is above what that leads to.
std::filesystem::path ConfigFile::beside(const std::string& name) {
  if (!name.empty()) names_.emplace_back(name);
  std::filesystem::path path = file_.parent_path() / name;
  if (std::find(path.begin(), path.end(), "..") == path.end()) path = path.lexically_normal();
  return name.empty() || path.has_filename() ? path : path.parent_path();  // "." is a folder's name
}

// Names the one other table that knows the key, else what is near in the key's own table. The top
// has no name to give, and of two tables neither is surely meant.
std::string ConfigFile::hint_of_key(std::string_view key,
                                    const std::set<std::string, std::less<>>& known) const {
  const auto has_key = [&](const auto& table) { return table.second.contains(key); };
  const auto found = std::ranges::find_if(asked_, has_key);
  if (found == asked_.end() || found->first.empty() || std::ranges::count_if(asked_, has_key) > 1)
    return nearest_or_all(key, known);
  return fmt::format("it is a key of [{}]", found->first);
}

std::vector<Problem> ConfigFile::problems() {
  // Tables to look through, breadth first. All tables [[name]] share a path, and so the known keys.
  std::vector<std::pair<const toml::table*, std::string>> open{{top_.get(), ""}};
  for (std::size_t i = 0; i < open.size(); ++i) {
    // A copy, as the list may be reallocated below.
    const auto [table, path] = open[i];
    const auto& known = asked_[path];
    for (auto&& [key, node] : *table) {
      const std::string name = dotted(path, key.str());
      if (!known.contains(key.str()))
        complain({where(node, name), "is not a known key", hint_of_key(key.str(), known)});
      else if (!asked_.contains(name))
        continue;  // a value, or keys of the user's own: judged where it was read
      else if (const toml::table* inner = node.as_table())
        open.emplace_back(inner, name);
      else if (const toml::array* list = node.as_array())
        for (const toml::node& item : *list)
          if (const toml::table* one = item.as_table()) open.emplace_back(one, name);
    }
  }
  return std::move(problems_);
}

void ConfigFile::complain(Problem problem) {
  problems_.push_back(std::move(problem));
}

void ConfigFile::finish() {
  if (std::vector<Problem> all = problems(); !all.empty()) throw InputError(std::move(all));
}

}  // namespace havers::io
