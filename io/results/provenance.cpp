#include "io/results/result_files.hpp"

namespace havers::io {

// Both come from CMake.
std::string version() {
  return HAVERS_VERSION;
}
std::string compiler_version() {
  return HAVERS_COMPILER;
}

}  // namespace havers::io
