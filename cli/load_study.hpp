// A study with its files read, reduced and measured: what `fit` calibrates and `check` looks at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/experiment/clocks.hpp"
#include "calib/study/study.hpp"
#include "io/config/read_study.hpp"
#include "sim/simulation.hpp"

namespace havers::cli {

/// A specimen's test before its reduction, for the figures.
struct TestRecord {
  calib::RawTest raw;
  std::optional<calib::ClockFit> clocks;  ///< Of a second logger, where there is one.
};

/// A study with everything that was read from its files.
struct LoadedStudy {
  calib::Study study;                         ///< Without the specimens that are left out.
  std::vector<sim::LeftOut> left_out;         ///< Specimens that cannot be used, and why.
  std::map<std::string, TestRecord> records;  ///< By specimen id.
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> overlays;  ///< Specimen id to PNGs.
  std::vector<std::filesystem::path> inputs;  ///< Every file that was read.
  // Doubts, a sentence each.
  std::vector<std::string> notes;       ///< Of the study itself.
  std::vector<std::string> file_notes;  ///< Of tests and sections, which carry them as well.

  /// `notes`, then `file_notes`.
  [[nodiscard]] std::vector<std::string> all_notes() const;
};

/// What the rates and angles of its tests ask of a study's model that it lacks: each key once.
std::vector<io::Problem> scene_problems(const calib::Study& study,
                                        const std::filesystem::path& file);

/// Reads a study, its tests and its sections, the specimens in parallel. A test that cannot be
/// reduced, or that quality control rejects, is left out. @throws io::InputError with the problems
/// of all files together, or why no specimen can be fitted; `known` then has the notes so far.
LoadedStudy load_study(const std::filesystem::path& file, const io::Overrides& overrides,
                       std::vector<std::string>* known = nullptr);

}  // namespace havers::cli
