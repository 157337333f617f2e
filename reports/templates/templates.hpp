// The HTML templates, as part of the program.
#pragma once

#include <map>
#include <string>

namespace havers::reports {

/// Name of a template (without ".mustache") to its text. Made from templates/ when the program is
/// built.
const std::map<std::string, std::string>& templates();

}  // namespace havers::reports
