// What this build is made of.
#pragma once

#include <string>

namespace havers::cli {

/// "havers 0.1.0".
std::string version();

/// Version, optional parts, and the libraries it was built with.
std::string version_text();

}  // namespace havers::cli
