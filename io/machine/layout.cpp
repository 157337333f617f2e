// The numbers are looked for first. Names, units and titles stand in the rows above them, which are
// read upwards.
#include "io/machine/layout.hpp"

#include <algorithm>

#include "io/machine/number.hpp"
#include "io/machine/split_unit.hpp"
#include "io/machine/units.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

// The first row of numbers from `begin` that is followed by another of the same length, or by
// nothing: a single row with two numbers may be a line of facts.
std::optional<std::size_t> first_number_row(const Preview& preview, std::size_t begin) {
  const auto& rows = preview.rows;
  for (std::size_t i = begin; i < rows.size(); ++i) {
    if (!is_number_row(rows[i], preview.dialect)) continue;
    if (i + 1 == rows.size() || rows[i + 1].cells.size() == rows[i].cells.size()) return i;
  }
  return std::nullopt;
}

bool in_brackets(const std::string& cell) {
  return without_brackets(cell).size() < cell.size();
}

// Only units, in brackets or known, and at least one that is known; or two in brackets or more,
// in whatever script.
bool is_unit_row(const PreviewRow& row) {
  const auto known = [](const std::string& cell) { return find_unit(cell).has_value(); };
  const auto may_be = [&](const std::string& cell) {
    return cell.empty() || in_brackets(cell) || known(cell);
  };
  return std::ranges::all_of(row.cells, may_be) &&
         (std::ranges::any_of(row.cells, known) ||
          std::ranges::count_if(row.cells, in_brackets) >= 2);
}

// Whether the row has a text that is no number for more than half of the columns.
bool may_name(const PreviewRow& row, std::size_t columns, char decimal) {
  const auto named = std::ranges::count_if(
      row.cells, [&](const auto& cell) { return !cell.empty() && !is_number(cell, decimal); });
  return 2 * static_cast<std::size_t>(named) > columns;
}

// Takes names and units column by column; without a row of units each unit is sought in the name.
void take_names(Table& table, const PreviewRow& names, const PreviewRow* units) {
  for (std::string cell : names.cells) {
    std::ranges::replace_if(
        cell, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    NameAndUnit column = split_unit(cell);
    const std::size_t i = table.names.size();
    if (units != nullptr && i < units->cells.size())
      column = {cell, std::string(without_brackets(units->cells[i]))};
    table.names.push_back(std::move(column.name));
    table.units.push_back(std::move(column.unit));
  }
}

// INSTRON Bluehill's raw data: key,"value",unit lines, a blank line, names, and below them units in
// round brackets.
bool is_bluehill(const Table& table, const PreviewRow* units) {
  return table.header_rows > 0 && units != nullptr &&
         std::ranges::all_of(units->cells,
                             [](const auto& cell) { return cell.empty() || cell.front() == '('; });
}

// The table whose numbers begin at this row.
Table table_at(const Preview& preview, std::size_t numbers) {
  const auto& rows = preview.rows;
  const std::size_t columns = rows[numbers].cells.size();
  const char decimal = preview.dialect.decimal;

  Table table;
  table.header_rows = numbers;
  table.first_line = rows[numbers].line;
  std::size_t above = numbers;
  const PreviewRow* units = nullptr;
  // From below: units, where names stand above them; then names; then units above the names.
  if (above >= 2 && is_unit_row(rows[above - 1]) && may_name(rows[above - 2], columns, decimal))
    units = &rows[--above];
  if (above >= 1 && may_name(rows[above - 1], columns, decimal)) {
    --above;
    const PreviewRow& names = rows[above];
    if (units == nullptr && above >= 1 && rows[above - 1].cells.size() == names.cells.size() &&
        is_unit_row(rows[above - 1]))
      units = &rows[--above];  // or above the names
    take_names(table, names, units);
    table.header_rows = above;
    if (above >= 1) table.titles = rows[above - 1].cells;
  }
  table.layout = is_bluehill(table, units) ? "Bluehill raw data" : "table";
  return table;
}

// One row per specimen, several results in it, and no time.
bool holds_results(const Table& table) {
  const auto times = std::ranges::count(table.names, Quantity::time, quantity_of_name);
  return times == 0 && std::ranges::count_if(table.names, is_result) >= 2;
}

// The smallest number of columns, two or more, after which names and units repeat; all columns
// where they do not.
std::size_t period_of(const Table& table, std::size_t columns) {
  for (std::size_t period = 2; period <= columns / 2; ++period) {
    bool repeats = columns % period == 0;
    for (std::size_t i = period; repeats && i < columns; ++i)
      repeats =
          table.names[i] == table.names[i - period] && table.units[i] == table.units[i - period];
    if (repeats) return period;
  }
  return columns;
}

// Whether the row above the names has cells above each specimen's first column and nowhere else.
bool has_titles(const Table& table, std::size_t period) {
  std::size_t named = 0;
  for (std::size_t i = 0; i < table.titles.size(); ++i) {
    if (table.titles[i].empty()) continue;
    if (i % period != 0 || table.titles[i].find('\n') != std::string::npos) return false;
    ++named;
  }
  return named > 0;
}

}  // namespace

std::vector<Table> side_by_side(const Table& table) {
  std::size_t columns = table.names.size();
  // Delimiters at the end of the lines make empty columns.
  while (columns > 0 && table.names[columns - 1].empty()) --columns;
  const std::size_t period = period_of(table, columns);
  // A single specimen's title is all that stands above its names; else it is a line of facts.
  const bool titled = has_titles(table, std::max<std::size_t>(period, 1)) &&
                      (period < columns || (table.header_rows == 1 && table.titles.size() >= 2));
  if (period == columns) {
    Table whole = table;
    if (titled) whole.title = table.titles[0];
    return {whole};
  }
  std::vector<Table> parts;
  for (std::size_t first = 0; first < columns; first += period) {
    Table part = table;
    const auto from = static_cast<std::ptrdiff_t>(first);
    const auto to = static_cast<std::ptrdiff_t>(first + period);
    part.names = {table.names.begin() + from, table.names.begin() + to};
    part.units = {table.units.begin() + from, table.units.begin() + to};
    part.first_column = first;
    if (titled && first < table.titles.size()) part.title = table.titles[first];
    parts.push_back(std::move(part));
  }
  return parts;
}

std::optional<Table> recognise_table(const Preview& preview) {
  // Results may stand above the raw data: the first table that is none of results counts.
  std::optional<Table> results;
  std::size_t begin = 0;
  while (const std::optional<std::size_t> numbers = first_number_row(preview, begin)) {
    Table table = table_at(preview, *numbers);
    if (!holds_results(table)) return table;
    table.layout = results_layout;
    if (!results) results = std::move(table);
    begin = *numbers + 1;
    while (begin < preview.rows.size() && is_number_row(preview.rows[begin], preview.dialect))
      ++begin;
  }
  return results;
}

}  // namespace havers::io
