// A run that keeps its simulations in its folder, and goes on with them where it was stopped.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "cli/command.hpp"
#include "cli/output_folder.hpp"

namespace havers::cli {

/// Whether a run was stopped in a folder: simulations are kept, and there is no result.
bool was_stopped(const std::filesystem::path& folder);

/// The folder of such a run: its results are staged as any run's, its simulations are written into
/// the target itself, where they survive a kill.
class KeptRun {
 public:
  /// Goes on with what a stopped run of the same command and inputs has left in the folder.
  /// @throws InputError as OutputFolder does, and when another run was stopped there, without
  /// --force.
  KeptRun(const char* command, const std::vector<std::filesystem::path>& inputs,
          const std::filesystem::path& folder, const CommonOptions& common);

  /// Where results are staged.
  OutputFolder& output() { return output_; }
  /// What was simulated before, and what will be.
  calib::EvaluationStore& store() { return *store_; }

 private:
  std::string name_;  ///< "fit of /home/me/femur/study.toml", by which it is known when stopped.
  bool resumes_;      ///< Declared before the folder, which would refuse what it holds.
  OutputFolder output_;
  std::unique_ptr<calib::EvaluationStore> store_;
};

}  // namespace havers::cli
