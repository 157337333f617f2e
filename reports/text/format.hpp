// Numbers as a reader wants them: few digits, a unit, and a dash for what is not known.
#pragma once

#include <string>
#include <string_view>

#include "calib/count.hpp"

namespace havers::reports {

/// What a value in SI units is divided by to be shown in the unit.
namespace in {
inline constexpr double percent = 0.01;
inline constexpr double um = 1e-6;   ///< [m]
inline constexpr double mm2 = 1e-6;  ///< [m²]
inline constexpr double mm = 1e-3;   ///< [m]
inline constexpr double MPa = 1e6;   ///< [Pa]
inline constexpr double GPa = 1e9;   ///< [Pa]
}  // namespace in

/// `digits` significant digits: "38.21", "0.004100", "3.21 × 10⁻¹⁴"; "–" when not finite.
std::string number(double value, int digits = 4);

/// 0 for the 1e-12 and less that rounding leaves of a logarithm of 1, or of a difference of
/// nothing.
double without_rounding(double value);

/// A number somebody chose, as they would write it: "13", "0.33", "10⁻⁸". Fewer digits for what
/// follows from what they chose.
std::string setting(double value, std::string_view unit = {}, int digits = 6);

/// A sentence with its numbers as a page writes them: "p = 3e-06" is "p = 3 × 10⁻⁶", "-2" "−2",
/// "r^-0.23" "r⁻⁰·²³", "45 deg" "45°"; no line ends between a number and its unit or its error.
std::string typeset(const std::string& sentence);

/// A number and its unit, held together by a space that does not break: "38.2 MPa"; "–" when not
/// finite.
std::string quantity(double value, std::string_view unit, int digits = 4);

/// Value and error to two digits of the error: "13.02 ± 0.14"; the value alone when the error is
/// not known.
std::string plus_minus(double value, double error);

/// "12.74 to 13.30", to two digits of the width and `more`; "–" when an end is not known.
std::string interval(double low, double high, int more = 0);

/// "12.90 (12.74 to 13.05)": value with the decimals of its interval, each with the unit.
std::string with_interval(double value, double low, double high, std::string_view unit = {},
                          int more = 0);

/// "p = 0.013"; no test is good enough for less than 10⁻⁶.
std::string chance(double p);

using calib::count;

/// The decimal prefix that brings `magnitude` between 1 and 1000.
struct Prefix {
  double factor = 1.0;
  std::string_view symbol;  ///< "k", "m", "µ", ...
};
Prefix prefix_for(double magnitude);

/// "20.0 ns": the number brought between 1 and 1000 by a prefix of the unit.
std::string prefixed(double value, std::string_view unit, int digits = 3);

/// 1, 2 or 5 times a power of ten, not above `limit` > 0.
double round_down(double limit);

/// Characters that could end a quoted string or a line of a gnuplot script, replaced; an apostrophe
/// by a curled one.
std::string plain(std::string_view text);

}  // namespace havers::reports
