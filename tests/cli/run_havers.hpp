// The program as a user runs it: a command line in, exit code and two streams out.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace havers::test {

struct Answer {
  int exit_code = -1;
  std::string out, err;
};

/// Runs `havers ARGUMENTS` through a shell, with `folder` as the working folder.
Answer run_havers(const std::filesystem::path& folder, const std::string& arguments);

/// Whether the program was built with OpenCV.
bool reads_images();

/// A new, empty folder of the running test's own.
std::filesystem::path own_folder();

void write_text(const std::filesystem::path& file, const std::string& text);

/// The text with the first `what` in it, which must be there, replaced.
std::string replaced_once(std::string text, const std::string& what, const std::string& by);

/// A scene that runs in milliseconds: 5 fibres in 8 layers, quasi-static.
std::string small_scene();

/// A study of two specimens, one at 0 and one at 90 degrees, of 5 fibres in 8 layers each, without
/// sections.
std::string small_study();

/// A folder of its own with scene.toml; with study.toml; with that and its tests in "made", made by
/// the program.
std::filesystem::path folder_with_scene();
std::filesystem::path folder_with_study();
std::filesystem::path folder_with_tests();

}  // namespace havers::test
