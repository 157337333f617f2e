// What a TOML file is, by its tables.
#pragma once

#include <filesystem>
#include <string_view>

#include "io/config/table_reader.hpp"

namespace havers::io {

/// What the file describes, and so which command takes it.
enum class FileKind { scene, study, sweep };

/// "scene", "study", "sweep".
std::string_view name_of(FileKind kind);

/// Study before sweep before scene; a file whose tables are of no kind is a scene.
/// @throws InputError when the file cannot be read or is not TOML, or an override is neither.
FileKind kind_of_file(const std::filesystem::path& file, const Overrides& overrides);

/// `top` is the file's. @throws InputError when the tables are those of another kind, whose keys
/// would all be unknown. A file with tables of no kind passes, and so does one with those of a
/// study and of a scene: the reader names the keys that are wrong.
void require_kind(FileKind expected, const TableReader& top, const std::filesystem::path& file);

}  // namespace havers::io
