// Built where VTK is not: says so.
#include "io/input_error.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {

bool snapshots_available() {
  return false;
}

void write_vtu(const std::filesystem::path& file, const sim::Assembly& /*assembly*/,
               const Eigen::VectorXd& /*displacements*/,
               const std::vector<sim::JointOutcome>& /*joints*/) {
  throw InputError(file.string(), "this build writes no snapshots for ParaView",
                   "apt-get install libvtk9-dev and build again");
}

}  // namespace havers::io
