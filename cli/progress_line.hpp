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

  /// Whether it is time to show something new: ten times a second at most.
  bool due();
  void show(const std::string& text);

 private:
  bool visible_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace havers::cli
