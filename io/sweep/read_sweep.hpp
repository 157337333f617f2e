// Sweep files (TOML): a scene, the keys that vary, and what is asked of the outcome.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/sweep/sweep.hpp"
#include "io/config/read_scene.hpp"

namespace havers::io {

/// A sweep as read, with a scene for every point.
struct SweepFile {
  calib::Sweep sweep;
  std::vector<std::filesystem::path> inputs;  ///< The sweep, and what its scenes name.
  std::vector<std::string> warnings{};        ///< A sentence each.
};

/// Reads a sweep; every point's scene is complete and possible.
/// @param overrides  of the scene and of the sweep, but not of a key that it varies.
/// @param seed  of the first run, instead of the file's.
/// @throws InputError with every problem, as read_scene; a problem of several points is named once.
SweepFile read_sweep(const std::filesystem::path& file, const Overrides& overrides = {},
                     std::optional<std::uint64_t> seed = {});

}  // namespace havers::io
