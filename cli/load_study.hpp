// A study with its files read, reduced and measured: what `fit` calibrates and `check` looks at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calib/study/study.hpp"
#include "io/config/read_study.hpp"

namespace havers::cli {

struct LoadedStudy {
  calib::Study study;
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> overlays;  ///< Specimen id to PNGs.
  std::vector<std::filesystem::path> inputs;  ///< Every file that was read.
  std::vector<std::string> warnings;          ///< A sentence each.
};

/// Reads a study, its tests and its sections, the sections in parallel.
/// @throws io::InputError with the problems of all files together.
LoadedStudy load_study(const std::filesystem::path& file, const io::Overrides& overrides);

}  // namespace havers::cli
