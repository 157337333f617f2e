// One line on the terminal that says how far a run is.
#pragma once

#include <chrono>
#include <string>

#include "cli/command.hpp"

namespace havers::cli {

/// Shows nothing unless stderr is a terminal and -q is not given; wipes its line when it ends.
class ProgressLine {
 public:
  explicit ProgressLine(const CommonOptions& common);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  /// Whether it is time to show something new: at most ten times a second, and never when nothing
  /// is shown. Ask before making a text, so that none is made in vain.
  bool due();
  /// Replaces what was shown before. Text beyond 79 columns is cut off.
  void show(const std::string& text);

 private:
  bool visible_;        ///< stderr is a terminal that can wipe a line, and -q is not given.
  bool shown_ = false;  ///< Whether there is a line to wipe.
  std::chrono::steady_clock::time_point next_;  ///< When the next text is due.
};

}  // namespace havers::cli
