#include "cli/interrupt.hpp"

#include <csignal>

namespace havers::cli {
namespace {

// A signal handler may touch nothing but such a flag.
volatile std::sig_atomic_t asked_to_stop =
    0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void ask_to_stop(int signal) {
  asked_to_stop = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

bool interrupted() {
  return asked_to_stop != 0;
}

}  // namespace havers::cli
