// Where a run leaves its files: whole, or not at all.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace havers::cli {

/// That havers has put a file of that name into the folder: a later run may replace it.
void take_note(const std::filesystem::path& folder, const std::string& name);

/// `name` without line breaks, or with the first number from 2 on that is not in `used` yet; it is
/// then.
std::string name_of_its_own(std::string name, std::set<std::string>& used);

/// Files are written into a staging folder beside the target, or in it where it is there already
/// and may be a disk of its own, and moved by `publish`; whatever was not published is removed
/// again, so that no run leaves half of its files.
class OutputFolder {
 public:
  /// @throws InputError when `folder` holds something and `force` is false, cannot be made, another
  /// run is writing there, or one of `inputs`, which this run reads, would be removed by `publish`.
  OutputFolder(const std::filesystem::path& folder, bool force,
               const std::vector<std::filesystem::path>& inputs = {});
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  OutputFolder(OutputFolder&&) = delete;
  OutputFolder& operator=(OutputFolder&&) = delete;

  /// The target; exists only after `publish` or `keep`.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// A file's place in the staging folder; folders in between are made.
  [[nodiscard]] std::filesystem::path stage(const std::filesystem::path& name) const;

  /// Writes a file there.
  void write(const std::filesystem::path& name, const std::string& content) const;

  /// A file's place in the target itself, for what must survive a kill.
  [[nodiscard]] std::filesystem::path keep(const std::filesystem::path& name) const;

  /// The files that earlier runs put into the target.
  enum class Earlier { goes, stays };
  /// Moves all staged files to the target.
  /// @throws InputError when a file of that name is there that no run has written: all are in a
  /// folder `results` of the target then
  void publish(Earlier earlier = Earlier::goes);

 private:
  std::filesystem::path folder_, staging_;   ///< Absolute, with links resolved.
  std::vector<std::filesystem::path> made_;  // above them
  int lock_ = -1;                            // on the staging folder: no other run writes there
};

}  // namespace havers::cli
