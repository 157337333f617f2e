// What pages and figures call a parameter of a fit.
#pragma once

#include <string>

namespace havers::reports {

/// "young_GPa[A1]" is young_GPa of A1: symbol and, in brackets, of what: "E [A1]".
std::string symbol_of(const std::string& parameter);

/// For an axis, with the unit once: "E [A1] (GPa)", "r".
std::string axis_label(const std::string& parameter);

}  // namespace havers::reports
