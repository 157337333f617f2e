// The file that table readers ask: where its keys stand, and what is wrong with them.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
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
  const toml::source_region& source = node.source();
  if (is_override(node)) return fmt::format("{}{}", override_mark, key);
  if (&node == top_.get() || source.begin.line == 0)
    return fmt::format("{}: {}", file_.string(), key);
  return fmt::format("{}:{}: {}", file_.string(), source.begin.line, key);
}

std::vector<Problem> ConfigFile::problems() {
  std::vector<std::pair<const toml::table*, std::string>> open{{top_.get(), ""}};
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [table, path] = open[i];
    const auto& known = asked_[path];
    for (auto&& [key, node] : *table) {
      const std::string name = dotted(path, key.str());
      if (!known.contains(key.str()))
        complain({where(node, name), "is not a known key", nearest_or_all(key.str(), known)});
      else if (!asked_.contains(name))
        continue;  // a value, judged where it was read
      else if (const toml::table* inner = node.as_table())
        open.emplace_back(inner, name);
      else if (const toml::array* list = node.as_array())
        for (const toml::node& item : *list)
          if (const toml::table* one = item.as_table()) open.emplace_back(one, name);
    }
  }
  return std::move(problems_);
}

// One mistake may stand in the way of many keys.
void ConfigFile::complain(Problem problem) {
  const auto same = [&](const Problem& other) { return to_string(other) == to_string(problem); };
  if (std::ranges::none_of(problems_, same)) problems_.push_back(std::move(problem));
}

void ConfigFile::finish() {
  if (std::vector<Problem> all = problems(); !all.empty()) throw InputError(std::move(all));
}

}  // namespace havers::io
