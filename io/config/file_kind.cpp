// A file is known by its tables at the top alone: a study has those of a scene under [model], a
// sweep beside its own.
#include "io/config/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace havers::io {
namespace {

struct KindWords {
  const char *name, *commands;
};

// In the order of FileKind.
constexpr std::array<KindWords, 3> kind_words{KindWords{"scene", "havers simulate takes it"},
                                              KindWords{"study", "havers fit takes it"},
                                              KindWords{"sweep", "havers sweep takes it"}};

const KindWords& words_of(FileKind kind) {
  return kind_words.at(static_cast<std::size_t>(kind));
}

// Whose tables a file has; a sweep has those of a scene too.
struct Tables {
  bool study, sweep, scene;
};

Tables tables_of(const TableReader& top) {
  const auto has_one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* name) { return top.has(name); });
  };
  return {.study = has_one_of({"study", "specimen", "calibrate"}),
          .sweep = top.has("sweep"),
          .scene = has_one_of({"assembly", "material", "joints", "loading", "solver"})};
}

FileKind kind_of(const Tables& tables) {
  if (tables.study) return FileKind::study;
  return tables.sweep ? FileKind::sweep : FileKind::scene;
}

}  // namespace

std::string_view name_of(FileKind kind) {
  return words_of(kind).name;
}

FileKind kind_of_file(const std::filesystem::path& file, const Overrides& overrides) {
  ConfigFile config(file, overrides);
  return kind_of(tables_of(config.top()));
}

void require_kind(FileKind expected, const TableReader& top, const std::filesystem::path& file) {
  const Tables tables = tables_of(top);
  // With tables of both a study and a scene either may be meant, and without any nothing is known:
  // the expected kind's reader then names each key that is wrong.
  const bool of_several = tables.study && tables.scene;
  const bool of_none = !tables.study && !tables.sweep && !tables.scene;
  const FileKind kind = kind_of(tables);
  if (kind == expected || of_several || of_none) return;
  throw InputError(file.string(),
                   fmt::format("is a {}, a {} is expected", name_of(kind), name_of(expected)),
                   words_of(kind).commands);
}

}  // namespace havers::io
