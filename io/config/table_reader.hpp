// A TOML file read key by key: what was asked for is known, everything else is a mistake of the
// user.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/config/key_unit.hpp"
#include "io/config/read_scene.hpp"
#include "io/config/words.hpp"
#include "io/input_error.hpp"

namespace toml {
inline namespace v3 {
class node;
class table;
}  // namespace v3
}  // namespace toml

namespace havers::io {

class ConfigFile;

/// "model.joints" for "model" and "joints"; either may be empty.
std::string dotted(const std::string& path, std::string_view name);

/// One table of a file. `key` leaves the value as it is, and answers false, when the key is absent
/// or wrong; what is wrong is collected in the file.
class TableReader {
 public:
  /// To be had from ConfigFile::top() and table().
  TableReader(ConfigFile& file, const toml::table* table, std::string path)
      : file_(&file), table_(table), path_(std::move(path)) {}

  /// A number in `unit`, whole or not; `value` is in SI units. The number must be finite, and 0 or
  /// from 1e-30 to 1e30 in size, so that squares and quotients of it can be computed.
  bool key(std::string_view name, double& value, KeyUnit unit = {});
  bool key(std::string_view name, int& value);            ///< At most 1e9 in size.
  bool key(std::string_view name, std::uint64_t& value);  ///< At most 2^63 − 1, as TOML has it.
  bool key(std::string_view name, bool& value);
  bool key(std::string_view name, std::string& value);
  bool key(std::string_view name, std::pair<double, double>& value);  ///< [5.0, 30.0]
  bool key(std::string_view name, std::vector<std::string>& value);   ///< Replaces a default.

  /// Paths are resolved against the file's folder.
  bool key(std::string_view name, std::filesystem::path& value);
  bool key(std::string_view name, std::vector<std::filesystem::path>& value);
  /// Complains unless the file that the key names is there.
  bool require_file(std::string_view name, const std::filesystem::path& file);

  /// One of the words of an enumeration; the complaint lists them.
  template <Worded E>
  bool key(std::string_view name, E& value) {
    const std::optional<std::size_t> index = word_index(name, {words<E>.begin(), words<E>.end()});
    if (index) value = static_cast<E>(*index);
    return index.has_value();
  }

  /// Stays without a value where the key is absent or wrong.
  template <class T, class... Units>
  bool key(std::string_view name, std::optional<T>& value, Units... unit) {
    T read{};
    const bool good = key(name, read, unit...);
    if (good) value = std::move(read);
    return good;
  }

  /// The table of that name, whose keys are then judged too; an absent one has no keys.
  TableReader table(std::string_view name);
  /// The tables [[name]], in the order of the file; none where it is absent, or wrong.
  std::vector<TableReader> tables(std::string_view name);

  /// The lists of an inner table whose keys are the user's own; every item as a TOML value.
  using List = std::pair<std::string, std::vector<std::string>>;
  std::vector<List> lists(std::string_view name);

  /// Whether the file has the key, be its value right or wrong; this does not make the key known.
  [[nodiscard]] bool has(std::string_view name) const;
  /// Whether the key holds a text, for keys that take a text or something else.
  [[nodiscard]] bool is_text(std::string_view name) const;
  /// Asks for the key. False, with a complaint, where it holds neither a text nor a number; an
  /// absent key is no fault.
  bool is_name_or_number(std::string_view name);
  /// A complaint about a key, dotted where it is of an inner table; it need not be in the file.
  void complain(std::string_view name, std::string what, std::string hint = {});
  void complain(const std::vector<Problem>& problems);  ///< Of a file that is named here.
  /// Complains unless the rule holds; the value is that of the key, in its unit.
  void require(bool holds, std::string_view name, double value, std::string_view rule);

 private:
  /// Makes the key known, and gives its node; null where it is absent.
  const toml::node* ask(std::string_view name);
  /// Complains, and answers false.
  bool wrong_type(std::string_view name, const toml::node& node, std::string_view expected);
  /// A value of exactly that TOML type; `expected` is what it must be, in words.
  template <class T>
  bool take(std::string_view name, T& value, std::string_view expected);
  /// A number within the limits; otherwise nothing, with a complaint.
  std::optional<double> usable_number(std::string_view name, const toml::node& node);
  /// A whole number; nothing where the key is absent or, with a complaint, wrong.
  std::optional<std::int64_t> whole_number(std::string_view name);
  /// The place of the key's text among the known words.
  std::optional<std::size_t> word_index(std::string_view name,
                                        const std::vector<std::string_view>& known);
  /// The key as the user would write it from the top of the file: "model.joints.scatter".
  [[nodiscard]] std::string full(std::string_view name) const;

  ConfigFile* file_;
  const toml::table* table_;  ///< Null when the file has no such table.
  std::string path_;          ///< "model.joints"; empty for the top.
};

/// The file, what was asked of it and what is wrong with it.
class ConfigFile {
 public:
  /// @throws InputError when the file cannot be read or is not TOML, or an override is neither.
  ConfigFile(std::filesystem::path file, const Overrides& overrides);
  ~ConfigFile();
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;

  /// The reader keeps a pointer to this file, which therefore can neither be copied nor moved.
  TableReader top();
  /// Adds a problem: of a key, of the file as a whole, or of another file that it names.
  void complain(Problem problem);
  /// All problems, unknown keys among them, moved out. To be called once, when all keys were asked
  /// for.
  std::vector<Problem> problems();
  /// @throws InputError with all problems, if there are any.
  void finish();

  /// The file, and those that it names and that are there.
  [[nodiscard]] const std::vector<std::filesystem::path>& inputs() const { return inputs_; }
  /// The names of files as they are written, whether those are there or not.
  [[nodiscard]] const std::vector<std::filesystem::path>& names() const { return names_; }

 private:
  /// A reader notes here what is asked and which files are named.
  friend class TableReader;
  /// Where a key stands: "file:line: key", or "--set key" where the command line gave it.
  [[nodiscard]] std::string where(const toml::node& node, const std::string& key) const;
  /// The path that a name means: relative to the file's folder, unless it is absolute.
  std::filesystem::path beside(const std::string& name);
  /// What to do about an unknown key of a table whose keys are `known`.
  [[nodiscard]] std::string hint_of_key(std::string_view key,
                                        const std::set<std::string, std::less<>>& known) const;

  std::filesystem::path file_;        ///< Empty: overrides alone.
  std::unique_ptr<toml::table> top_;  ///< A pointer, to keep toml++ out of this header.
  std::vector<std::filesystem::path> inputs_{file_}, names_;
  std::map<std::string, std::set<std::string, std::less<>>> asked_;  ///< Keys by the table's path.
  std::vector<Problem> problems_;
};

}  // namespace havers::io
