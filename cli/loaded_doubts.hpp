// What can be fitted, though it is hardly meant: sentences for the notes of a study.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/load_study.hpp"

namespace havers::cli {

/// Sections that count twice, angles that are not said. Looks only at what the study names, not at
/// measurements, so that the study may still have problems.
void doubt_specimens(const std::vector<io::SpecimenFiles>& specimens, LoadedStudy& loaded);

/// What a specimen's files say of themselves.
struct OwnWords {
  std::size_t number = 0;              ///< In its test's file, from 1; 0 where that was not read.
  std::string test_id{}, logger_id{};  ///< The specimen's.
};

/// Tests and gauges that two specimens have, and files that name another specimen of the study than
/// the one that they are given to. @param own  as `specimens`
void doubt_tests(const std::vector<io::SpecimenFiles>& specimens, const std::vector<OwnWords>& own,
                 LoadedStudy& loaded);

/// Angles that hardly differ, scatter, pores, rate and search, once all specimens are taken.
void doubt_model(bool rate_is_given, LoadedStudy& loaded);

}  // namespace havers::cli
