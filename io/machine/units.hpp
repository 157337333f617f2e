// Units of testing machines and what they are in SI.
#pragma once

#include <optional>
#include <string_view>

namespace havers::io {

/// What a unit measures. A ratio of lengths is a strain.
enum class Dimension { time, force, length, area, stress, strain, voltage };

/// A known unit, or a factor per volt.
struct Unit {
  Dimension dimension = Dimension::strain;
  double to_si = 1.0;  ///< Factor to s, N, m, m², Pa, 1 or V.
};

/// The unit a text names: "kN", "(mm)", "[ MPa ]", "sec"; upper and lower case as in the table
/// first, then any. A calibration factor is a unit too: "500 N/V" is a force.
std::optional<Unit> find_unit(std::string_view text);

/// Whether nothing but a strain is measured in it, as in microstrain; % has many uses.
bool is_of_strain_alone(const Unit& unit);

/// Text without the blanks and tabs around it.
std::string_view without_blanks(std::string_view text);

/// And without one pair of brackets around it, nor blanks inside that.
std::string_view without_brackets(std::string_view text);

}  // namespace havers::io
