// What a result carries so that it can be reproduced and its input files can be recognised.
#include "cli/provenance.hpp"

#include <utility>

#include "io/results/result_files.hpp"
#include "io/results/sha256.hpp"

namespace havers::cli {

Digests digests_of(const std::vector<std::filesystem::path>& inputs) {
  Digests digests;
  for (const auto& file : inputs)  // what came through a pipe is gone
    digests[file.string()] = std::filesystem::is_regular_file(file) ? io::sha256(file) : "not kept";
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
