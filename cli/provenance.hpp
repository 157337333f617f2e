// Where a result comes from and what it took.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calib/provenance.hpp"
#include "cli/command.hpp"
#include "sim/stopwatch.hpp"

namespace havers::cli {

/// Started with a command, read when its result is written.
using sim::Stopwatch;

/// File names to SHA-256; to be taken as files are read, for users may change them during a run.
using Digests = std::map<std::string, std::string>;
Digests digests_of(const std::vector<std::filesystem::path>& inputs);

/// The command as typed, the inputs' digests, and the time so far.
/// Call it when the result is complete, as the time so far is stated as the time of the run.
calib::Provenance provenance_of(const CommonOptions& common, Digests inputs,
                                const Stopwatch& watch);

}  // namespace havers::cli
