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

/// The folder of a run that can be continued after it was stopped. Results are staged as those of
/// any run; simulations are kept in the target itself, where they survive a kill.
class KeptRun {
 public:
  /// Goes on with what a stopped run of the same command and `files` has left in the folder;
  /// `inputs` are these and all that they name.
  /// @throws InputError as OutputFolder does, and when another run was stopped there, without
  /// --force.
  KeptRun(const char* command, const std::vector<std::filesystem::path>& files,
          const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& folder,
          const CommonOptions& common);

  /// For the results.
  OutputFolder& output() { return output_; }
  /// Simulations of a stopped run, if there was one, and those of this run.
  calib::EvaluationStore& store() { return *store_; }

 private:
  std::string name_;  ///< "fit of /home/me/femur/study.toml", by which it is known when stopped.
  bool resumes_;      ///< Declared before output_, which needs it to accept its folder.
  OutputFolder output_;
  std::unique_ptr<calib::EvaluationStore> store_;
};

}  // namespace havers::cli
