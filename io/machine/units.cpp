// A table of names, searched first as written and then without regard to case, as mN and MN differ
// by 1e9. Units of weight become forces by standard gravity.
#include "io/machine/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "io/machine/number.hpp"

namespace havers::io {
namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr double standard_gravity = 9.80665;             // m/s²
constexpr double pound = 0.45359237 * standard_gravity;  // N
constexpr double inch = 0.0254;                          // m
constexpr double microstrain = 1e-6;

using enum Dimension;
// A linear search suffices: names, units and header lines are looked up, never cells of numbers.
constexpr std::array units{
    NamedUnit{"s", {time, 1.0}},
    NamedUnit{"sec", {time, 1.0}},
    NamedUnit{"ms", {time, 1e-3}},
    NamedUnit{"min", {time, 60.0}},
    NamedUnit{"h", {time, 3600.0}},
    NamedUnit{"second", {time, 1.0}},
    NamedUnit{"seconds", {time, 1.0}},
    NamedUnit{"secs", {time, 1.0}},
    NamedUnit{"msec", {time, 1e-3}},
    NamedUnit{"us", {time, 1e-6}},
    NamedUnit{"µs", {time, 1e-6}},  // micro sign
    NamedUnit{"μs", {time, 1e-6}},  // Greek mu
    NamedUnit{"usec", {time, 1e-6}},
    NamedUnit{"microseconds", {time, 1e-6}},
    NamedUnit{"milliseconds", {time, 1e-3}},
    NamedUnit{"ns", {time, 1e-9}},
    NamedUnit{"minute", {time, 60.0}},
    NamedUnit{"minutes", {time, 60.0}},
    NamedUnit{"hour", {time, 3600.0}},
    NamedUnit{"hours", {time, 3600.0}},
    NamedUnit{"hh:mm:ss", {time, 1.0}},  // read as a clock, in s
    NamedUnit{"mm:ss", {time, 1.0}},
    NamedUnit{"N", {force, 1.0}},
    NamedUnit{"kN", {force, 1e3}},
    NamedUnit{"mN", {force, 1e-3}},
    NamedUnit{"MN", {force, 1e6}},
    NamedUnit{"cN", {force, 1e-2}},
    NamedUnit{"daN", {force, 10.0}},
    NamedUnit{"newton", {force, 1.0}},
    NamedUnit{"newtons", {force, 1.0}},
    NamedUnit{"kilonewton", {force, 1e3}},
    NamedUnit{"kilonewtons", {force, 1e3}},
    NamedUnit{"lbf", {force, pound}},
    NamedUnit{"lb", {force, pound}},
    NamedUnit{"lbs", {force, pound}},
    NamedUnit{"pounds", {force, pound}},
    NamedUnit{"kip", {force, 1e3 * pound}},
    NamedUnit{"kgf", {force, standard_gravity}},
    NamedUnit{"kp", {force, standard_gravity}},
    NamedUnit{"gf", {force, 1e-3 * standard_gravity}},
    NamedUnit{"m", {length, 1.0}},
    NamedUnit{"cm", {length, 1e-2}},
    NamedUnit{"mm", {length, 1e-3}},
    NamedUnit{"um", {length, 1e-6}},
    NamedUnit{"µm", {length, 1e-6}},  // micro sign
    NamedUnit{"μm", {length, 1e-6}},  // Greek mu
    NamedUnit{"in", {length, inch}},
    NamedUnit{"inch", {length, inch}},
    NamedUnit{"inches", {length, inch}},
    NamedUnit{"micron", {length, 1e-6}},
    NamedUnit{"microns", {length, 1e-6}},
    NamedUnit{"millimeter", {length, 1e-3}},
    NamedUnit{"millimeters", {length, 1e-3}},
    NamedUnit{"millimetre", {length, 1e-3}},
    NamedUnit{"millimetres", {length, 1e-3}},
    NamedUnit{"meter", {length, 1.0}},
    NamedUnit{"meters", {length, 1.0}},
    NamedUnit{"metre", {length, 1.0}},
    NamedUnit{"metres", {length, 1.0}},
    NamedUnit{"mm2", {area, 1e-6}},
    NamedUnit{"mm^2", {area, 1e-6}},
    NamedUnit{"mm²", {area, 1e-6}},
    NamedUnit{"cm2", {area, 1e-4}},
    NamedUnit{"cm^2", {area, 1e-4}},
    NamedUnit{"cm²", {area, 1e-4}},
    NamedUnit{"in2", {area, inch* inch}},
    NamedUnit{"in^2", {area, inch* inch}},
    NamedUnit{"in²", {area, inch* inch}},
    NamedUnit{"Pa", {stress, 1.0}},
    NamedUnit{"kPa", {stress, 1e3}},
    NamedUnit{"MPa", {stress, 1e6}},
    NamedUnit{"N/mm2", {stress, 1e6}},
    NamedUnit{"N/mm^2", {stress, 1e6}},
    NamedUnit{"N/mm²", {stress, 1e6}},
    NamedUnit{"GPa", {stress, 1e9}},
    NamedUnit{"psi", {stress, pound / (inch * inch)}},
    NamedUnit{"ksi", {stress, 1e3 * pound / (inch * inch)}},
    NamedUnit{"kgf/mm2", {stress, 1e6 * standard_gravity}},
    NamedUnit{"kgf/mm^2", {stress, 1e6 * standard_gravity}},
    NamedUnit{"kgf/mm²", {stress, 1e6 * standard_gravity}},
    NamedUnit{"%", {strain, 1e-2}},
    NamedUnit{"percent", {strain, 1e-2}},
    NamedUnit{"pct", {strain, 1e-2}},
    NamedUnit{"‰", {strain, 1e-3}},
    NamedUnit{"mm/m", {strain, 1e-3}},
    NamedUnit{"mm/mm", {strain, 1.0}},
    NamedUnit{"m/m", {strain, 1.0}},
    NamedUnit{"in/in", {strain, 1.0}},
    NamedUnit{"-", {strain, 1.0}},
    NamedUnit{"ustrain", {strain, microstrain}},
    NamedUnit{"µstrain", {strain, microstrain}},
    NamedUnit{"μstrain", {strain, microstrain}},
    NamedUnit{"microstrain", {strain, microstrain}},
    NamedUnit{"mstrain", {strain, 1e-3}},
    NamedUnit{"um/m", {strain, microstrain}},
    NamedUnit{"µm/m", {strain, microstrain}},
    NamedUnit{"μm/m", {strain, microstrain}},
    NamedUnit{"µε", {strain, microstrain}},
    NamedUnit{"με", {strain, microstrain}},
    NamedUnit{"ue", {strain, microstrain}},
    NamedUnit{"ppm", {strain, microstrain}},
    NamedUnit{"1e-6", {strain, microstrain}},
    NamedUnit{"10^-6", {strain, microstrain}},
    NamedUnit{"uε", {strain, microstrain}},
    NamedUnit{"V", {voltage, 1.0}},
    NamedUnit{"mV", {voltage, 1e-3}},
};

bool equal_but_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

// A unit by its name in the table; prefixes are not split off.
std::optional<Unit> listed_unit(std::string_view name) {
  const auto* found = std::ranges::find(units, name, &NamedUnit::name);
  if (found == units.end())
    found = std::ranges::find_if(
        units, [&](const NamedUnit& unit) { return equal_but_case(unit.name, name); });
  if (found == units.end()) return std::nullopt;
  return found->unit;
}

// "500 N/V", "0.001 mm/mm/V": what a volt stands for.
std::optional<Unit> calibration(std::string_view text) {
  if (!text.ends_with("/V")) return std::nullopt;
  text.remove_suffix(2);
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  const Number factor = parse_number(text.substr(0, blank));
  std::optional<Unit> unit = listed_unit(without_brackets(text.substr(blank + 1)));
  if (factor.fault != NumberFault::none || factor.value == 0.0 || !unit) return std::nullopt;
  unit->to_si *= factor.value;
  return unit;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_brackets(std::string_view text) {
  text = without_blanks(text);
  if (text.size() < 2) return text;
  const bool round = text.front() == '(' && text.back() == ')';
  const bool square = text.front() == '[' && text.back() == ']';
  return round || square ? without_blanks(text.substr(1, text.size() - 2)) : text;
}

bool is_of_strain_alone(const Unit& unit) {
  return unit.dimension == Dimension::strain && unit.to_si == microstrain;
}

std::optional<Unit> find_unit(std::string_view text) {
  const std::string_view name = without_brackets(text);
  if (const std::optional<Unit> factor = calibration(name)) return factor;
  return listed_unit(name);
}

}  // namespace havers::io
