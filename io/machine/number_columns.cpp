// Rows come one by one and are not kept. What is wrong with a row is added to the problems, and the
// caller reads on until there are enough of them.
#include "io/machine/number_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "io/machine/excerpt.hpp"

namespace havers::io {
namespace {

// Whether none of the specimen's channels has a cell in the row.
bool has_ended(const Row& row, const SpecimenColumns& specimen) {
  return std::ranges::all_of(specimen.channels, [&](const Channel& channel) {
    return channel.column >= row.cells.size() || row.cells[channel.column].empty();
  });
}

// A clock that goes back by most of a day has passed midnight: the whole days that it lacks against
// the time before are added. Going back by less than half a day stays a fault.
void check_time(const Row& row, SpecimenColumns& specimen, std::vector<Problem>& problems) {
  constexpr double day = 86400.0;
  for (std::size_t i = 0; i < specimen.channels.size(); ++i) {
    std::vector<double>& values = specimen.values[i];
    if (specimen.channels[i].quantity != Quantity::time || values.size() < 2) continue;
    const double before = values[values.size() - 2];
    double& now = values.back();
    const bool clock = row.cells[specimen.channels[i].column].find(':') != std::string_view::npos;
    specimen.clock = specimen.clock || clock;
    if (clock && before > now) now += day * std::round((before - now) / day);
    if (now < before)
      problems.push_back({at_line(specimen.file.file, row.line),
                          fmt::format("time goes back from {:.6g} s to {:.6g} s", before, now),
                          "one table holds one test"});
  }
}

// Nothing, NaN, or dashes: a gauge that is not there.
bool is_no_reading_of(const Channel& channel, std::string_view cell, NumberFault fault) {
  if (channel.quantity != Quantity::strain || fault == NumberFault::none) return false;
  return fault == NumberFault::empty || fault == NumberFault::not_finite ||
         cell.find_first_not_of("-–—") == std::string_view::npos;
}

// A gauge may come late or be lost on the way; a gap between its readings is a fault.
void take_reading(SpecimenColumns& specimen, std::vector<Problem>& problems) {
  if (specimen.told && specimen.lost) problems.push_back(*specimen.lost);
  specimen.told = true;
  specimen.lost.reset();
}

// False where the row is not taken to its end. The channels then differ in length, but a problem is
// noted, and the file is refused.
bool take_cells(const Row& row, char decimal, SpecimenColumns& specimen,
                std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < specimen.channels.size(); ++i) {
    const Channel& channel = specimen.channels[i];
    if (channel.column >= row.cells.size()) {
      problems.push_back({at_line(specimen.file.file, row.line),
                          fmt::format("the row ends after {} of {} columns", row.cells.size(),
                                      specimen.file.columns.size()),
                          "the file may be cut off here"});
      return false;
    }
    const std::string_view cell = row.cells[channel.column];
    const Number number = read_cell(cell, decimal, channel);
    const auto complaint = [&] {
      return bad_cell(specimen.file, row.line, specimen.file.columns[channel.in_file], cell,
                      number.fault);
    };
    if (is_no_reading_of(channel, cell, number.fault)) {
      // A gap is a fault only when a reading follows; the first cell of it is named. A second gauge
      // may have any: `join_gauge_pair` looks.
      if (!specimen.lost && !channel.second_gauge) specimen.lost = complaint();
      specimen.values[i].push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    if (number.fault != NumberFault::none) {
      problems.push_back(complaint());
      return false;
    }
    if (channel.quantity == Quantity::strain && !channel.second_gauge)
      take_reading(specimen, problems);
    specimen.values[i].push_back(number.value);
  }
  return true;
}

// More cells than names: a decimal comma among commas, or a row of something else.
void check_width(const Row& row, std::span<const SpecimenColumns> side_by_side,
                 std::vector<Problem>& problems) {
  std::size_t columns = 0;
  for (const SpecimenColumns& specimen : side_by_side) columns += specimen.file.columns.size();
  if (row.cells.size() <= columns) return;
  const auto surplus = row.cells.subspan(columns);
  if (std::ranges::all_of(surplus, [](std::string_view cell) { return cell.empty(); })) return;
  problems.push_back(
      {at_line(side_by_side.front().file.file, row.line),
       fmt::format("the row has {} cells, and there are {} columns", row.cells.size(), columns),
       "is the decimal mark also the delimiter?"});
}

}  // namespace

Number read_cell(std::string_view cell, char decimal, const Channel& channel) {
  Number number = parse_number(cell, decimal);
  if (number.fault == NumberFault::text && channel.quantity == Quantity::time)
    return parse_clock(cell);  // in s, whatever the unit
  number.value *= channel.to_si;
  if (std::isinf(number.value)) number.fault = NumberFault::too_large;
  return number;
}

void take_numbers(const Row& row, char decimal, std::span<SpecimenColumns> side_by_side,
                  std::vector<Problem>& problems) {
  check_width(row, side_by_side, problems);
  for (SpecimenColumns& specimen : side_by_side) {
    // Empty cells end a specimen only beside others; of a single one they are a fault.
    if (side_by_side.size() > 1 && has_ended(row, specimen)) {
      specimen.ended = true;
      continue;
    }
    if (specimen.ended) {
      problems.push_back({at_line(specimen.file.file, row.line),
                          fmt::format("specimen {} of the file goes on after rows without cells",
                                      specimen.file.number),
                          "fill them, or leave them out"});
      return;
    }
    if (!take_cells(row, decimal, specimen, problems)) return;
    check_time(row, specimen, problems);
  }
}

Problem bad_cell(const TestFile& file, std::size_t line, const Column& column,
                 std::string_view cell, NumberFault fault) {
  const bool clock = column.quantity == Quantity::time && !cell.empty() &&
                     std::isdigit(static_cast<unsigned char>(cell.front())) != 0 &&
                     cell.find(':') != std::string_view::npos;
  return {
      at_line(file.file, line),
      fmt::format(R"(column "{}": "{}" {})", excerpt(column.name), excerpt(cell), to_string(fault)),
      fault == NumberFault::empty ? "export all channels at one rate, or leave the row out"
      : clock                     ? "a clock's time is 10:00:01, or 1:00:01 PM"
                                  : ""};
}

}  // namespace havers::io
