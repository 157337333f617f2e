#include "cli/progress_line.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

namespace havers::cli {
namespace {

constexpr const char* wipe = "\r\033[K";

}  // namespace

ProgressLine::ProgressLine(const CommonOptions& common)
    : visible_(!common.quiet && isatty(STDERR_FILENO) != 0),
      next_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs(wipe, stderr);
}

bool ProgressLine::due() {
  if (!visible_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds(100);
  return true;
}

void ProgressLine::show(const std::string& text) {
  // No longer than a narrow terminal: a wrapped line could not be wiped.
  fmt::print(stderr, "{}{:.79}", wipe, text);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace havers::cli
