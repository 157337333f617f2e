// The lines of a header are split into key, value and unit, whatever their form. A line whose key
// `fact_of_key` knows tells a fact of the specimen; all others are passed over.
#include "io/machine/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "io/machine/excerpt.hpp"
#include "io/machine/fact_names.hpp"
#include "io/machine/number.hpp"
#include "io/machine/split_unit.hpp"
#include "io/machine/units.hpp"

namespace havers::io {
namespace {

struct HeaderLine {
  std::string key, value, unit;
};

// "Width [mm]:" and "4.00", or "Width" and "4.00 mm": a unit behind the value counts first.
HeaderLine key_and_value(std::string_view written, std::string_view value) {
  while (written.ends_with(':') || written.ends_with(' ')) written.remove_suffix(1);
  auto [key, unit] = split_unit(written);
  const std::size_t blank = value.rfind(' ');
  if (blank == std::string_view::npos || !find_unit(value.substr(blank + 1)))
    return {std::move(key), std::string(value), std::move(unit)};
  return {std::move(key), std::string(value.substr(0, blank)),
          std::string(value.substr(blank + 1))};
}

// A unit in a cell of its own counts before all others.
HeaderLine header_line(const PreviewRow& row) {
  HeaderLine line = key_and_value(row.cells[0], row.cells[1]);
  if (row.cells.size() > 2 && !row.cells[2].empty()) line.unit = without_brackets(row.cells[2]);
  return line;
}

// "Width: 4.00 mm" in a single cell, as MTS writes its header; "Specimen 4".
HeaderLine header_line(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos)
    // A heading without a name has an empty value, which is passed over.
    return {"specimen number", std::string(name_in_heading(text)), {}};
  return key_and_value(text.substr(0, colon), without_blanks(text.substr(colon + 1)));
}

// A row is a line, or, where it is one cell, as many as the cell has.
std::vector<HeaderLine> header_lines(const PreviewRow& row) {
  const std::string& cell = row.cells[0];
  const bool several = cell.find_first_of("\r\n") != std::string::npos;
  const bool alone = std::ranges::all_of(std::span(row.cells).subspan(1),
                                         [](const auto& other) { return other.empty(); });
  if (!several && !alone) return {header_line(row)};
  std::vector<HeaderLine> lines;
  for (std::string_view rest = cell; !rest.empty();) {
    const std::size_t length = std::min(rest.find_first_of("\r\n"), rest.size());
    lines.push_back(header_line(rest.substr(0, length)));
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  return lines;
}

// The member that keeps a size; a bare length is kept as the gauge length.
std::optional<double>& dimension_of(Fact fact, calib::RawTest& test) {
  if (fact == Fact::width) return test.width;
  if (fact == Fact::thickness) return test.thickness;
  if (fact == Fact::area) return test.area;
  if (fact == Fact::extensometer_length) return test.extensometer_length;
  return test.gauge_length;
}

// A length or area in SI; nothing, with a warning, where the line gives none.
std::optional<double> size_of(const HeaderLine& line, Fact fact, std::string& warning) {
  const Dimension wanted = fact == Fact::area ? Dimension::area : Dimension::length;
  const Number number = parse_lone_number(line.value);
  if (number.fault != NumberFault::none || number.value <= 0.0) {
    warning = fmt::format("\"{}\" is no size; the line is not used", excerpt(line.value));
    return std::nullopt;
  }
  if (line.unit.empty()) {
    warning = wanted == Dimension::area ? "no unit, taken as mm²" : "no unit, taken as mm";
    return number.value * (wanted == Dimension::area ? 1e-6 : 1e-3);
  }
  const std::optional<Unit> unit = find_unit(line.unit);
  if (!unit || unit->dimension != wanted) {
    warning =
        fmt::format("\"{}\" is not a known unit of it; the line is not used", excerpt(line.unit));
    return std::nullopt;
  }
  return number.value * unit->to_si;
}

// A size that a line of the header gave.
struct HeaderSize {
  Fact fact;
  std::string key;
  double value;
};

// The user may correct a size. Width and thickness are in every stress: more than 15 % is said. Ten
// times the gauge length is a slip of the unit, and a strain that was recorded needs none; a bare
// length may be that of the whole specimen, a hundred times the gauge length it is not. Both sizes
// are in m. Empty where they are near each other.
std::string far_from(double given, const HeaderSize& fresh) {
  const bool gauge = fresh.fact == Fact::length || fresh.fact == Fact::gauge_length;
  const double most = fresh.fact == Fact::length ? 100.0 : gauge ? 10.0 : 1.15;
  const double ratio = std::max(given, fresh.value) / std::min(given, fresh.value);
  if (ratio < most) return {};
  return fmt::format("{:.6g} mm here, and {:.6g} mm is given{}: {}, check both", 1e3 * fresh.value,
                     1e3 * given, gauge ? " as gauge length" : "",
                     gauge ? "the given one counts where an elongation is to be a strain"
                           : "the given one is used");
}

// A gauge length beats the length of the specimen; else the first of two counts. `sizes` holds what
// the header has given so far: a size in `test` that is not among them is the user's.
void take_size(HeaderSize fresh, std::vector<HeaderSize>& sizes, calib::RawTest& test,
               std::string& warning) {
  std::optional<double>& size = dimension_of(fresh.fact, test);
  const auto before = std::ranges::find_if(
      sizes, [&](const HeaderSize& taken) { return &dimension_of(taken.fact, test) == &size; });
  if (before == sizes.end()) {
    if (size) {  // given by the user
      if (std::string far = far_from(*size, fresh); !far.empty()) warning = std::move(far);
      return;
    }
    size = fresh.value;
    sizes.push_back(std::move(fresh));
    return;
  }
  if (before->fact != fresh.fact) {
    // Only a gauge length and a bare length share a member.
    if (fresh.fact == Fact::length) return;
    size = fresh.value;
    *before = std::move(fresh);
    return;
  }
  constexpr double rounding = 1e-9;
  if (std::abs(fresh.value - before->value) <= rounding * before->value) return;
  const double to_shown = fresh.fact == Fact::area ? 1e6 : 1e3;
  warning = fmt::format("{1:.6g} {0} differs from {3:.6g} {0} of \"{2}\" above: the first is used",
                        fresh.fact == Fact::area ? "mm²" : "mm", to_shown * fresh.value,
                        excerpt(before->key), to_shown * before->value);
}

bool is_name(Fact fact) {
  return fact == Fact::specimen_id || fact == Fact::specimen_number;
}

void take_fact(const HeaderLine& line, std::size_t number, std::vector<HeaderSize>& sizes,
               calib::RawTest& test) {
  const std::optional<Fact> fact = fact_of_key(line.key);
  if (!fact || line.value.empty() || is_name(*fact)) return;
  std::string warning;
  if (const std::optional<double> value = size_of(line, *fact, warning)) {
    // A round bar has no width: its diameter gives the area.
    const bool round = *fact == Fact::diameter;
    take_size({round ? Fact::area : *fact, line.key,
               round ? 0.25 * std::numbers::pi * *value * *value : *value},
              sizes, test, warning);
  }
  if (!warning.empty())
    test.warnings.push_back(fmt::format("line {}, {}: {}", number, excerpt(line.key), warning));
}

// Width times thickness counts (X1).
void compare_area(calib::RawTest& test) {
  constexpr double rounding = 0.01;
  if (!test.area || !test.width || !test.thickness) return;
  const double used = *test.width * *test.thickness;
  if (std::abs(*test.area - used) <= rounding * used) return;
  test.warnings.push_back(fmt::format(
      "the file's area of {:.6g} mm² is not width x thickness, {:.6g} mm²: the latter is used, "
      "check them",
      1e6 * *test.area, 1e6 * used));
}

// One of the two alone makes no area, and changes nothing where the file states one.
void name_idle_size(bool width_given, calib::RawTest& test) {
  if (!test.area || test.width.has_value() == test.thickness.has_value()) return;
  const std::string given = width_given ? "width" : "thickness";
  const std::string unknown = width_given ? "thickness" : "width";
  test.warnings.push_back(
      fmt::format("the {} of {:.6g} mm that is given changes nothing: the file's area, {:.6g} mm², "
                  "counts where the {} is unknown (add {}_mm)",
                  given, 1e3 * (width_given ? *test.width : *test.thickness), 1e6 * *test.area,
                  unknown, unknown));
}

}  // namespace

void read_facts(std::span<const PreviewRow> header, calib::RawTest& test) {
  const bool width_given = test.width.has_value(), thickness_given = test.thickness.has_value();
  std::vector<HeaderSize> sizes;
  for (const PreviewRow& row : header)
    for (const HeaderLine& line : header_lines(row)) take_fact(line, row.line, sizes, test);
  // An id counts before a number, wherever they stand.
  for (const Fact name : {Fact::specimen_id, Fact::specimen_number})  // the first of two counts
    for (const PreviewRow& row : header)
      for (const HeaderLine& line : header_lines(row))
        if (test.specimen_id.empty() && fact_of_key(line.key) == name)
          test.specimen_id = line.value;
  compare_area(test);
  if (width_given != thickness_given) name_idle_size(width_given, test);
}

}  // namespace havers::io
