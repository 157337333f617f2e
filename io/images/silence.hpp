// Decoders that speak for themselves. Private to io/images.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace havers::images {

/// While one lives, what is written to stderr is lost: OpenCV and libpng say there what is wrong
/// with a file, and the caller's own message says it again. Only one exists at a time; other
/// threads wait. It redirects the file descriptor, not std::cerr, which libraries in C do not use.
class Silence {
 public:
  Silence() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere < 0) return;
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~Silence() {
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static inline std::mutex only_one;
  /// Declared before `kept_`, so that it is locked before stderr is saved and until it is restored.
  std::lock_guard<std::mutex> alone_{only_one};
  int kept_;  ///< A copy of stderr's descriptor; negative if it could not be copied.
};

}  // namespace havers::images
