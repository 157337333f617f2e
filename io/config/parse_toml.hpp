// TOML text to a table, with the overrides of the command line on top.
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "io/config/read_scene.hpp"

namespace havers::io {

/// What the source of an overriding value starts with, where that of others is the file.
inline constexpr std::string_view override_mark = "--set ";

/// Whether the command line gave the node.
bool is_override(const toml::node& node);

/// No file: the overrides alone. @throws InputError when the file cannot be read, is not TOML or
/// holds no key, and for overrides that are not key=value.
toml::table parse_toml(const std::filesystem::path& file, const Overrides& overrides);

}  // namespace havers::io
