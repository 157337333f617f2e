#include "io/machine/number_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/machine/number.hpp"

namespace havers::io {
namespace {

// A file that is wrong in every row need not say so in every row.
constexpr std::size_t enough_problems = 5;

}  // namespace

InputError open_quote(const std::string& file, std::size_t line) {
  return {fmt::format("{}:{}", file, line), "a quote is opened and never closed",
          "the file may be cut off or damaged here"};
}

NumberColumns::NumberColumns(const TestFile& file, std::size_t first_line, const Dialect& dialect,
                             const std::vector<Channel>& channels)
    : file_(file),
      first_line_(first_line),
      dialect_(dialect),
      channels_(channels),
      values_(channels.size()) {}

void NumberColumns::read(std::string_view beginning, TextSource& source) {
  CsvRows rows(dialect_.delimiter, [this](const Row& row) { return take_row(row); });
  for (std::string_view block = beginning; !block.empty(); block = source.next())
    if (!rows.feed(block)) break;
  if (const std::size_t line = rows.open_quote_line(); line > 0 && problems_.empty())
    throw open_quote(file_.file, line);
  rows.finish();
  if (!problems_.empty()) throw InputError(std::move(problems_));
}

bool NumberColumns::take_row(const Row& row) {
  if (row.line < first_line_) return true;
  const bool empty = std::ranges::all_of(row.cells, [](auto cell) { return cell.empty(); });
  if (!empty) take_cells(row);
  return problems_.size() < enough_problems;
}

void NumberColumns::take_cells(const Row& row) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    if (channel.column >= row.cells.size())
      return complain(row,
                      fmt::format("the row ends after {} of {} columns", row.cells.size(),
                                  file_.columns.size()),
                      "the file may be cut off here");
    const std::string_view cell = row.cells[channel.column];
    const Number number = parse_number(cell, dialect_.decimal);
    if (number.fault != NumberFault::none)
      return complain(
          row, fmt::format(R"(column "{}": "{}" {})", file_.columns[channel.column].name, cell,
                           to_string(number.fault)));
    values_[i].push_back(number.value * channel.to_si);
  }
  check_time(row);
}

void NumberColumns::check_time(const Row& row) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const std::vector<double>& values = values_[i];
    if (channels_[i].quantity != Quantity::time || values.size() < 2) continue;
    const double before = values[values.size() - 2], now = values.back();
    if (now < before)
      complain(row, fmt::format("time goes back from {:.6g} s to {:.6g} s", before, now),
               "one file holds one test");
  }
}

void NumberColumns::complain(const Row& row, std::string what, std::string hint) {
  problems_.push_back(
      {fmt::format("{}:{}", file_.file, row.line), std::move(what), std::move(hint)});
}

}  // namespace havers::io
