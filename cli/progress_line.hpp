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

  /// Whether it is time to show something new: ten times a second at most. Asked before a text is
  /// made, which would cost for nothing otherwise.
  bool due();
  /// In place of what it showed before; cut at 79 characters.
  void show(const std::string& text);

 private:
  bool visible_;        ///< stderr is a terminal that can wipe a line, and nobody asked for quiet.
  bool shown_ = false;  ///< Whether there is a line to wipe.
  std::chrono::steady_clock::time_point next_;  ///< From when on it is due.
};

}  // namespace havers::cli
