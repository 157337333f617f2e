// One program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace havers::reports {

/// How a program ended, and all that it wrote.
struct ProcessResult {
  bool started = false;  ///< False also if its input cannot be written to a file.
  int status = -1;       ///< Exit status; -1 when it did not end by itself.
  std::string output, errors;
};

/// Runs a command (program and arguments), found through PATH and without a shell, with `input` on
/// its standard input, in a process group of its own. It is killed after two minutes.
ProcessResult run_process(std::vector<std::string> command, const std::string& input);

}  // namespace havers::reports
