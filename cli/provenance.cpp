#include "cli/provenance.hpp"

#include <fmt/core.h>

#include <utility>

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

io::Provenance provenance_of(const CommonOptions& common, Digests inputs, const Stopwatch& watch) {
  io::Provenance provenance;
  provenance.command = common.command_line;
  provenance.inputs = std::move(inputs);
  provenance.wall_seconds = watch.wall_seconds();
  provenance.cpu_seconds = watch.cpu_seconds();
  return provenance;
}

reports::Provenance page_facts(const io::Provenance& provenance) {
  reports::Provenance facts{
      {"Command", provenance.command},
      {"Program", fmt::format("havers {}, {}", provenance.havers, provenance.compiler)}};
  for (const auto& [file, digest] : provenance.inputs)
    facts.emplace_back(file, "SHA-256 " + digest);
  facts.emplace_back("Wall time", fmt::format("{:.3g} s", provenance.wall_seconds));
  facts.emplace_back("CPU time", fmt::format("{:.3g} s", provenance.cpu_seconds));
  return facts;
}

}  // namespace havers::cli
