#include "io/machine/facts.hpp"

#include <fmt/format.h>

#include <optional>

#include "io/machine/number.hpp"
#include "io/machine/units.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

struct HeaderLine {
  std::string key, value, unit;
};

HeaderLine header_line(const PreviewRow& row) {
  auto [key, unit] = split_unit(row.cells[0]);
  if (row.cells.size() > 2 && !row.cells[2].empty()) unit = without_brackets(row.cells[2]);
  return {key, row.cells[1], unit};
}

std::optional<double>& dimension_of(Fact fact, calib::RawTest& test) {
  if (fact == Fact::width) return test.width;
  if (fact == Fact::thickness) return test.thickness;
  if (fact == Fact::area) return test.area;
  return test.gauge_length;
}

// A length or area in SI; nothing, with a warning, where the line gives none.
std::optional<double> size_of(const HeaderLine& line, Fact fact, char decimal,
                              std::string& warning) {
  const Dimension wanted = fact == Fact::area ? Dimension::area : Dimension::length;
  Number number = parse_number(line.value, decimal);
  if (number.fault != NumberFault::none) number = parse_number(line.value);
  if (number.fault != NumberFault::none || number.value <= 0.0) {
    warning = fmt::format("\"{}\" is no size; the line is not used", line.value);
    return std::nullopt;
  }
  if (line.unit.empty()) {
    warning = wanted == Dimension::area ? "no unit, taken as mm²" : "no unit, taken as mm";
    return number.value * (wanted == Dimension::area ? 1e-6 : 1e-3);
  }
  const std::optional<Unit> unit = find_unit(line.unit);
  if (!unit || unit->dimension != wanted) {
    warning = fmt::format("\"{}\" is not a known unit of it; the line is not used", line.unit);
    return std::nullopt;
  }
  return number.value * unit->to_si;
}

}  // namespace

void read_facts(std::span<const PreviewRow> header, char decimal, calib::RawTest& test) {
  for (const PreviewRow& row : header) {
    if (row.cells.size() < 2) continue;
    const HeaderLine line = header_line(row);
    const std::optional<Fact> fact = fact_of_key(line.key);
    if (!fact || line.value.empty()) continue;
    if (*fact == Fact::specimen_id) {
      if (test.specimen_id.empty()) test.specimen_id = line.value;
      continue;
    }
    std::string warning;
    std::optional<double>& size = dimension_of(*fact, test);
    if (!size) size = size_of(line, *fact, decimal, warning);
    if (!warning.empty())
      test.warnings.push_back(fmt::format("line {}, {}: {}", row.line, line.key, warning));
  }
}

}  // namespace havers::io
