#include "cli/provenance.hpp"

#include <utility>

#include "io/results/result_files.hpp"
#include "io/results/sha256.hpp"

namespace havers::cli {

double Stopwatch::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
}

double Stopwatch::cpu_seconds() const {
  return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
}

Digests digests_of(const std::vector<std::filesystem::path>& inputs) {
  Digests digests;
  for (const auto& file : inputs) digests[file.string()] = io::sha256(file);
  return digests;
}

calib::Provenance provenance_of(const CommonOptions& common, Digests inputs,
                                const Stopwatch& watch) {
  calib::Provenance provenance;
  provenance.havers = io::version();
  provenance.compiler = io::compiler_version();
  provenance.command = common.command_line;
  provenance.inputs = std::move(inputs);
  provenance.wall_seconds = watch.wall_seconds();
  provenance.cpu_seconds = watch.cpu_seconds();
  return provenance;
}

}  // namespace havers::cli
