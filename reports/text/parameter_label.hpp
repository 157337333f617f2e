// What pages and figures call a parameter of a fit.
#pragma once

#include <string>
#include <vector>

namespace havers::reports {

/// "young_GPa[A1]" is young_GPa of A1: symbol and, in brackets, of what: "E [A1]", "E [45°]".
std::string symbol_of(const std::string& parameter);

/// For an axis, with the unit once: "E [A1] (GPa)", "r".
std::string axis_label(const std::string& parameter);

/// A formula with its parameters as symbols: "head_tail_MPa × ratio^-0.23" is "σ₁ × r^-0.23". A key
/// to be written into a study, "calibrate.bounds.ratio", stays.
std::string with_symbols(std::string sentence, std::vector<std::string> parameters);

}  // namespace havers::reports
