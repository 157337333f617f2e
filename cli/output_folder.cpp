// A run's files are written to a staging folder and renamed into place, so that a run that is
// killed leaves no result that only looks complete. A list of names tells later runs what they may
// replace.
#include "cli/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "io/input_error.hpp"
#include "io/results/result_files.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

// The files that runs of havers have put into a folder, by their paths in it, a line each: these
// may be replaced.
constexpr const char* own_names = ".havers";
constexpr const char* last_name = "result.json";
constexpr const char* staging_name = ".partial";  // in a target that is there

// As the kernel takes it: `..` behind a link is above what that leads to.
fs::path resolved(const fs::path& path) {
  const fs::path full = fs::weakly_canonical(fs::absolute(path));
  return full.has_filename() ? full : full.parent_path();
}

// Files of these names may be removed later: none may lie outside the folder, nor behind a link.
bool lies_in(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  const fs::path file = folder / name, above = file.parent_path();
  return name.is_relative() && name.has_filename() && name.filename() != "." &&
         name.filename() != ".." && fs::weakly_canonical(above, error) == above;
}

std::set<std::string> names_of_runs(const fs::path& folder) {
  const fs::path there = resolved(folder);
  std::set<std::string> names;
  std::ifstream file(there / own_names);
  for (std::string name; std::getline(file, name);)
    if (lies_in(there, name)) names.insert(name);
  return names;
}

// A name with a line break would be read as two, and be another file's.
void write_names(const fs::path& folder, std::set<std::string> names) {
  std::erase_if(names,
                [](const std::string& name) { return name.find('\n') != std::string::npos; });
  io::write_file(folder / own_names, fmt::format("{}\n", fmt::join(names, "\n")));
}

// A link that leads nowhere is there too, and a file where a folder above must be.
bool is_in_the_way(const fs::path& folder, const fs::path& name, const std::set<std::string>& own) {
  for (fs::path above = name.parent_path(); !above.empty(); above = above.parent_path())
    if (fs::exists(fs::symlink_status(folder / above)) && !fs::is_directory(folder / above) &&
        !own.contains(above.string()))
      return true;
  return fs::exists(fs::symlink_status(folder / name)) && !own.contains(name.string());
}

// Every file in a folder and the folders in it.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

// Files, and the folders that they leave empty.
void remove_files(const fs::path& folder, const std::set<std::string>& names) {
  for (const fs::path name : names) {
    fs::remove(folder / name);
    std::error_code not_empty;
    fs::path above = name.parent_path();
    while (!above.empty() && fs::remove(folder / above, not_empty)) above = above.parent_path();
  }
}

[[noreturn]] void refuse_to_replace(const fs::path& file, const std::string& hint) {
  throw io::InputError(file.string(), "was not written by a run of havers and stays", hint);
}

// What took long to compute is not lost with its place: it gets a folder of its own in the target.
fs::path set_apart(const fs::path& staging, const fs::path& folder,
                   const std::set<std::string>& staged) {
  write_names(staging, staged);
  fs::path apart = folder / "results";
  for (int number = 2; fs::exists(fs::symlink_status(apart)); ++number)
    apart = folder / fmt::format("results_{}", number);
  fs::rename(staging, apart);
  return apart;
}

// The staging folder of a run that was killed does not count.
bool holds_something(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& entry) { return entry.path().filename() != staging_name; });
}

// A target that is not there yet stays so until it is whole.
fs::path staging_beside(const fs::path& folder) {
  return folder.parent_path() / fmt::format(".{}.partial", folder.filename().string());
}

// What a run has to make above its staging folder, the deepest first.
std::vector<fs::path> missing_above(const fs::path& staging) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path path = staging.parent_path(); !path.empty() && !fs::exists(path, ignored);
       path = path.parent_path())
    missing.push_back(path);
  return missing;
}

// A descriptor that holds the staging folder of a run, which a kill lets go of; -1: there is none.
int lock(const fs::path& staging) {
  const int held = open(staging.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (held < 0 || flock(held, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return held;
  close(held);
  throw io::InputError(staging.string(), "is in use: another run is writing there",
                       "wait for it, or give another folder after -o");
}

// What would be removed and may not be: a folder, as its files are not known, and what is read now.
void refuse_to_remove(const fs::path& folder, const std::set<std::string>& own,
                      const std::vector<fs::path>& inputs) {
  std::error_code error;
  std::set<fs::path> needed;
  for (const fs::path& input : inputs) needed.insert(fs::weakly_canonical(input, error));
  for (const std::string& name : own) {
    if (fs::is_directory(folder / name, error) && !fs::is_empty(folder / name, error))
      throw io::InputError((folder / name).string(),
                           "is a folder that may hold files of your own, and stays",
                           "move it away, or give another folder after -o");
    if (needed.contains(fs::weakly_canonical(folder / name, error)))
      throw io::InputError((folder / name).string(),
                           "is read by this run, which would remove it with the earlier run",
                           "give another folder after -o");
  }
}

void refuse_to_overwrite(const fs::path& folder, bool force, const std::vector<fs::path>& inputs) {
  if (!fs::exists(fs::symlink_status(folder))) return;
  if (!fs::exists(folder))
    throw io::InputError(folder.string(), "is a link that leads nowhere",
                         "give another folder after -o");
  if (!fs::is_directory(folder))
    throw io::InputError(folder.string(), "is a file, not a folder",
                         "give another folder after -o");
  const std::set<std::string> own = names_of_runs(folder);
  if (!force && holds_something(folder))
    throw io::InputError(folder.string(), "is not empty",
                         own.empty() ? "no run has written there; give another folder, or --force "
                                       "to write beside what it holds"
                                     : "give another folder, or --force to replace the run in it");
  // Also with --force: better refused here than after the run, when its result is to be moved.
  if (is_in_the_way(folder, last_name, own))
    refuse_to_replace(folder / last_name, "give another folder after -o");
  refuse_to_remove(folder, own, inputs);
}

}  // namespace

void take_note(const fs::path& folder, const std::string& name) {
  std::set<std::string> names = names_of_runs(folder);
  if (names.insert(name).second) write_names(folder, names);
}

std::string name_of_its_own(std::string name, std::set<std::string>& used) {
  std::ranges::replace(name, '\n', ' ');
  std::string own = name;
  for (int number = 2; !used.insert(own).second; ++number) own = fmt::format("{}_{}", name, number);
  return own;
}

OutputFolder::OutputFolder(const fs::path& folder, bool force, const std::vector<fs::path>& inputs)
    : folder_(resolved(folder)),
      staging_(fs::exists(folder_) ? folder_ / staging_name : staging_beside(folder_)),
      made_(missing_above(staging_)) {
  // Before anything is made or removed.
  refuse_to_overwrite(folder_, force, inputs);
  std::error_code error;
  for (const fs::path& left : {staging_beside(folder_), staging_}) {  // by a run that was killed
    close(lock(left));  // lock() throws if that run is still going on.
    fs::remove_all(left, error);
  }
  fs::create_directories(staging_, error);
  if (error) throw io::InputError(folder.string(), "cannot be written: " + error.message());
  lock_ = lock(staging_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  close(lock_);
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // where nothing is in it
}

fs::path OutputFolder::stage(const fs::path& name) const {
  fs::create_directories((staging_ / name).parent_path());
  return staging_ / name;
}

void OutputFolder::write(const fs::path& name, const std::string& content) const {
  io::write_file(stage(name), content);
}

fs::path OutputFolder::keep(const fs::path& name) const {
  fs::create_directories(folder_);
  return folder_ / name;
}

void OutputFolder::publish(Earlier earlier) {
  fs::create_directories(folder_);
  std::set<std::string> staged = files_in(staging_), old = names_of_runs(folder_);
  // Before anything is moved, all places must be free.
  for (const std::string& name : staged)
    if (is_in_the_way(folder_, name, old))
      refuse_to_replace(folder_ / name, "this run's results are in " +
                                            set_apart(staging_, folder_, staged).string());
  std::set<std::string> own = staged;
  own.insert(old.begin(), old.end());
  // Names are written before files are moved: if the run is killed in between, a later run may
  // replace the files that are already there.
  write_names(folder_, own);
  // The result goes first and comes last: where it stands, its run is complete, whenever a kill
  // came.
  if (earlier == Earlier::goes) {
    if (old.erase(last_name) > 0) fs::remove(folder_ / last_name);
    remove_files(folder_, old);
    write_names(folder_, staged);  // What is gone may be the user's name tomorrow.
  }
  const auto move = [&](const fs::path& name) {
    fs::create_directories((folder_ / name).parent_path());
    fs::rename(staging_ / name, folder_ / name);
  };
  const bool has_result = staged.erase(last_name) > 0;
  std::ranges::for_each(staged, move);
  if (has_result) move(last_name);
}

}  // namespace havers::cli
