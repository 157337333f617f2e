// What a TOML file is, by its tables.
#pragma once

#include <filesystem>

#include "io/config/table_reader.hpp"

namespace havers::io {

enum class FileKind { scene, study, sweep };

/// @throws InputError when the tables are those of another kind, whose keys would all be unknown.
void require_kind(FileKind expected, const TableReader& top, const std::filesystem::path& file);

}  // namespace havers::io
