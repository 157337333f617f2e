#include "cli/progress_line.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace havers::cli {
namespace {

constexpr const char* wipe = "\r\033[K";

// That knows how to wipe a line.
bool is_terminal(int descriptor) {
  const char* kind = std::getenv("TERM");
  return isatty(descriptor) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

}  // namespace

ProgressLine::ProgressLine(const CommonOptions& common)
    : visible_(!common.quiet && is_terminal(STDERR_FILENO)),
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
  std::fputs(fmt::format("{}{:.79}", wipe, text).c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace havers::cli
