// Scene files (TOML) to sim::Scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scene.hpp"

namespace havers::io {

/// `--set key=value` of the command line: dotted key as in the file, value as TOML; a bare word is
/// a string.
using Overrides = std::vector<std::string>;

/// A scene as read, and what surrounds it in its file.
struct SceneFile {
  sim::Scene scene;
  int snapshots = 0;                            ///< .vtu files to write.
  std::vector<std::filesystem::path> inputs{};  ///< The scene, and what it names.
  std::vector<std::string> warnings{};          ///< Of keys that change nothing, and of doubts.
};

/// Whether a reader of the scene writes the snapshots that it asks for, and so needs VTK.
enum class Snapshots { ignored, written };

/// Reads a scene. Paths in it are relative to its folder.
/// @throws InputError with every problem: unknown keys (with the nearest known one), wrong types,
/// impossible values, missing files.
SceneFile read_scene(const std::filesystem::path& file, const Overrides& overrides = {},
                     Snapshots snapshots = Snapshots::ignored);

}  // namespace havers::io
