// What can be fitted, though it is hardly meant: sentences for the notes of a study.
#pragma once

#include <vector>

#include "cli/load_study.hpp"

namespace havers::cli {

/// Sections that count twice, angles that are not said. Looks only at what the study names, not at
/// measurements, so that the study may still have problems.
void doubt_specimens(const std::vector<io::SpecimenFiles>& specimens, LoadedStudy& loaded);

/// Angles that hardly differ, scatter, pores, rate and search, once all specimens are taken.
void doubt_model(bool rate_is_given, LoadedStudy& loaded);

}  // namespace havers::cli
