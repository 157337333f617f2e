// What this build is made of.
#pragma once

#include <string>

namespace havers::cli {

/// Version, optional parts, and the libraries it was built with.
std::string version_text();

}  // namespace havers::cli
