#include "cli/output_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "io/input_error.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

// What a run of havers may have left: an earlier run's must not stand beside a later one's.
constexpr std::array results{"result.json",    "scene.toml",   "report.html",   "curve.csv",
                             "joints.csv",     "fracture.svg", "avalanche.svg", "terms.csv",
                             "replicates.csv", "curves",       "overlays",      "snapshots"};

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path full = fs::absolute(path).lexically_normal();
  return full.has_filename() ? full : full.parent_path();
}

void refuse_to_overwrite(const fs::path& folder, bool force) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    throw io::InputError(folder.string(), "is a file, not a folder",
                         "give another folder after -o");
  if (!force && !fs::is_empty(folder))
    throw io::InputError(folder.string(), "is not empty",
                         "give another folder, or --force to replace the run in it");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder, bool force)
    : folder_(without_trailing_slash(folder)),
      staging_(folder_.parent_path() / fmt::format(".{}.partial", folder_.filename().string())) {
  refuse_to_overwrite(folder_, force);
  std::error_code error;
  fs::remove_all(staging_, error);
  fs::create_directories(staging_, error);
  if (error) throw io::InputError(folder.string(), "cannot be written: " + error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

fs::path OutputFolder::stage(const fs::path& name) const {
  fs::create_directories((staging_ / name).parent_path());
  return staging_ / name;
}

fs::path OutputFolder::keep(const fs::path& name) const {
  fs::create_directories(folder_);
  return folder_ / name;
}

void OutputFolder::publish() {
  fs::create_directories(folder_);
  for (const char* name : results) fs::remove_all(folder_ / name);
  const auto move = [&](const fs::path& staged) {
    const fs::path target = folder_ / staged.filename();
    fs::remove_all(target);
    fs::rename(staged, target);
  };
  // The result last: where it stands, the run is complete, whenever a kill came.
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(staging_))
    if (entry.path().filename() != results.front()) others.push_back(entry.path());
  std::ranges::for_each(others, move);
  if (fs::exists(staging_ / results.front())) move(staging_ / results.front());
}

}  // namespace havers::cli
