#include "cli/kept_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/input_error.hpp"
#include "io/read_text.hpp"
#include "io/results/result_files.hpp"
#include "io/store/sqlite_store.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* store_name = "evaluations.sqlite";
constexpr const char* run_name = ".run";  // whose simulations are kept

// With absolute paths, so that a run can be continued from another working directory.
std::string name_of_run(const char* command, const std::vector<fs::path>& inputs) {
  std::vector<std::string> files;
  files.reserve(inputs.size());
  for (const fs::path& input : inputs) files.push_back(fs::weakly_canonical(input).string());
  return fmt::format("{} of {}", command, fmt::join(files, ", "));
}

// Whether `run` is the one that was stopped in the folder. If no name was left, it is taken to be.
bool goes_on(const fs::path& folder, const std::string& run, bool force) {
  if (!was_stopped(folder)) return false;
  const fs::path file = folder / run_name;
  const std::string stopped = fs::is_regular_file(file) ? io::read_text(file, "") : run;
  if (stopped != run && !force)
    throw io::InputError(folder.string(), "holds an unfinished " + stopped,
                         "give another folder, or --force to put this run in its place, with the "
                         "simulations that both need");
  return stopped == run;
}

}  // namespace

bool was_stopped(const fs::path& folder) {
  return fs::exists(folder / store_name) && !fs::exists(folder / "result.json");
}

KeptRun::KeptRun(const char* command, const std::vector<fs::path>& files,
                 const std::vector<fs::path>& inputs, const fs::path& folder,
                 const CommonOptions& common)
    : name_(name_of_run(command, files)),
      resumes_(goes_on(folder, name_, common.force)),
      output_(folder, common.force || resumes_, inputs) {
  if (resumes_) note(common, "going on with the simulations kept in " + folder.string());
  // In the target itself, not staged: from now on every simulation survives a kill.
  store_ = io::open_store(output_.keep(store_name));
  io::write_file(output_.keep(run_name), name_);
  // Noted, so that a later run may replace the file.
  take_note(output_.folder(), run_name);
}

}  // namespace havers::cli
