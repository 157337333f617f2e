// havers bench has modes: error against run time of a scene, and one more for each flag.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/command.hpp"

namespace havers::cli {

/// The arguments of all modes together; each mode uses a few of them.
struct BenchArguments {
  std::filesystem::path scene;  ///< Empty in modes that need none.
  std::filesystem::path folder;
  int seeds = 3;    ///< Runs of each setting.
  int studies = 0;  ///< Known studies of a calibration's bench; 0: as many as the mode wants.
  int costly = 1;   ///< Unknowns of theirs whose moves need new simulations, 1 or 2.
};

/// A mode is one function that returns the exit code; bench.cpp lists them with their flags.
using BenchMode = int (*)(const BenchArguments& arguments, const CommonOptions& common);

/// What every mode leaves.
struct BenchFiles {
  const nlohmann::json& result;
  std::string csv_name, csv;
  std::string page;  ///< Empty: none.
};
/// Writes result.json, the CSV and the page, publishes the folder and answers.
void leave(const BenchFiles& files, const CommonOptions& common, OutputFolder& output,
           const std::function<void()>& print);

/// The modes. All return 0 only if the bench was finished and its outcome is as it must be.
int bench_scene(const BenchArguments& arguments, const CommonOptions& common);
int bench_stability(const BenchArguments& arguments, const CommonOptions& common);
int bench_porosity(const BenchArguments& arguments, const CommonOptions& common);
int bench_calibration(const BenchArguments& arguments, const CommonOptions& common);
int bench_coverage(const BenchArguments& arguments, const CommonOptions& common);

}  // namespace havers::cli
