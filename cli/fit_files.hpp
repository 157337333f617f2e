// What a fit leaves in its folder, and how its page is made, now or later again.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>

#include "cli/load_study.hpp"
#include "cli/output_folder.hpp"
#include "io/results/result_files.hpp"
#include "reports/pages.hpp"

namespace havers::cli {

/// Stages result.json, the calibrated scene.toml, terms.csv, replicates.csv, curves/ and overlays/;
/// tests/ and report.html where this build makes pages.
/// Returns what is in result.json.
nlohmann::json write_fit(const OutputFolder& output, const LoadedStudy& loaded,
                         const calib::CalibrationResult& result,
                         const calib::Provenance& provenance);

/// A finished fit, read back from its folder.
struct FinishedFit {
  io::FitFolder fit;
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> overlays;  ///< Specimen id to PNGs.
  std::map<std::string, std::vector<std::string>> tests;                   ///< And to SVGs.

  /// What its page shows; holds references to this object.
  [[nodiscard]] reports::FitReport report() const;
};

/// The folder of a fit that is named by itself or by its result.json.
std::filesystem::path folder_of_fit(const std::filesystem::path& result);

/// @throws io::InputError when that is no finished fit.
FinishedFit read_fit(const std::filesystem::path& result);

}  // namespace havers::cli
