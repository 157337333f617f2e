#include "cli/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace havers::cli {
namespace {

// A signal handler may touch nothing but such a flag, and all threads ask for it.
std::atomic<bool> asked_to_stop =
    false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free);

void ask_to_stop(int signal) {
  asked_to_stop = true;
  // From now on the signal has its usual effect: a second one ends the program at once.
  std::signal(signal, SIG_DFL);
}

}  // namespace

// What a parent ignores stays ignored: a shell does so for what it runs in the background.
void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, ask_to_stop) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool interrupted() {
  return asked_to_stop;
}

}  // namespace havers::cli
