// Decoders that speak for themselves. Private to io/images.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace havers::images {

/// While one lives, what is written to stderr is lost: OpenCV and libpng say there what is wrong
/// with a file, and a caller's answer says it again. One at a time; others wait. The descriptor is
/// turned, not a stream, for libraries in C write past std::cerr.
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
  /// Declared before `kept_`: held before stderr is put aside, and until it is back.
  std::lock_guard<std::mutex> alone_{only_one};
  int kept_;  ///< stderr as it was; negative where there is none.
};

}  // namespace havers::images
