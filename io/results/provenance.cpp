#include <nlohmann/json.hpp>

#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {

// Both come from CMake.
std::string version() {
  return HAVERS_VERSION;
}
std::string compiler_version() {
  return HAVERS_COMPILER;
}

nlohmann::json provenance_object(const calib::Provenance& provenance) {
  return json_of(provenance);
}

}  // namespace havers::io
