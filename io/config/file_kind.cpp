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

constexpr std::array<KindWords, 3> kind_words{KindWords{"scene", "havers simulate takes it"},
                                              KindWords{"study", "havers fit takes it"},
                                              KindWords{"sweep", "havers sweep takes it"}};

// A sweep has the tables of a scene too; a file with tables of several kinds may be any of them.
FileKind kind_of(const TableReader& top, FileKind expected) {
  const auto has_one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* name) { return top.has(name); });
  };
  const bool study = has_one_of({"study", "specimen", "calibrate"});
  const bool scene = has_one_of({"assembly", "material", "joints", "loading", "solver"});
  if (study && scene) return expected;
  if (study) return FileKind::study;
  if (top.has("sweep")) return FileKind::sweep;
  return scene ? FileKind::scene : expected;
}

}  // namespace

void require_kind(FileKind expected, const TableReader& top, const std::filesystem::path& file) {
  const FileKind kind = kind_of(top, expected);
  if (kind == expected) return;
  const KindWords& words = kind_words.at(static_cast<std::size_t>(kind));
  throw InputError(file.string(),
                   fmt::format("is a {}, a {} is expected", words.name,
                               kind_words.at(static_cast<std::size_t>(expected)).name),
                   words.commands);
}

}  // namespace havers::io
