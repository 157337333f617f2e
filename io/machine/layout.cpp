#include "io/machine/layout.hpp"

#include <algorithm>
#include <array>

#include "io/machine/number.hpp"
#include "io/machine/units.hpp"

namespace havers::io {
namespace {

constexpr std::array<Recognise, 2> layouts{recognise_bluehill, recognise_any_table};

// The first row of numbers that is followed by another of the same length, or by nothing.
std::optional<std::size_t> first_number_row(const Preview& preview) {
  const auto& rows = preview.rows;
  const char decimal = preview.dialect.decimal;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!is_number_row(rows[i], decimal)) continue;
    if (i + 1 == rows.size() || rows[i + 1].cells.size() == rows[i].cells.size()) return i;
  }
  return std::nullopt;
}

bool in_brackets(const std::string& cell) {
  return without_brackets(cell).size() < cell.size();
}

// Only units, in brackets or known, and at least one that is known.
bool is_unit_row(const PreviewRow& row) {
  const auto may_be = [](const std::string& cell) {
    return cell.empty() || in_brackets(cell) || find_unit(cell).has_value();
  };
  return std::ranges::all_of(row.cells, may_be) &&
         std::ranges::any_of(row.cells,
                             [](const auto& cell) { return find_unit(cell).has_value(); });
}

bool may_name(const PreviewRow& row, std::size_t columns, char decimal) {
  const auto named = std::ranges::count_if(
      row.cells, [&](const auto& cell) { return !cell.empty() && !is_number(cell, decimal); });
  return 2 * static_cast<std::size_t>(named) > columns;
}

void take_names(Table& table, const PreviewRow& names, const PreviewRow* units) {
  for (const std::string& cell : names.cells) {
    NameAndUnit column = split_unit(cell);
    const std::size_t i = table.names.size();
    if (units != nullptr && i < units->cells.size())
      column = {cell, std::string(without_brackets(units->cells[i]))};
    table.names.push_back(std::move(column.name));
    table.units.push_back(std::move(column.unit));
  }
}

}  // namespace

std::optional<Table> recognise_table(const Preview& preview) {
  for (const Recognise recognise : layouts)
    if (std::optional<Table> table = recognise(preview)) return table;
  return std::nullopt;
}

std::optional<Table> recognise_any_table(const Preview& preview) {
  const std::optional<std::size_t> numbers = first_number_row(preview);
  if (!numbers) return std::nullopt;
  const auto& rows = preview.rows;
  const std::size_t columns = rows[*numbers].cells.size();
  const char decimal = preview.dialect.decimal;

  Table table;
  table.layout = "table";
  table.header_rows = *numbers;
  table.first_line = rows[*numbers].line;
  std::size_t above = *numbers;
  const PreviewRow* units = nullptr;
  if (above >= 2 && is_unit_row(rows[above - 1]) && may_name(rows[above - 2], columns, decimal))
    units = &rows[--above];
  if (above >= 1 && may_name(rows[above - 1], columns, decimal)) {
    take_names(table, rows[above - 1], units);
    table.header_rows = above - 1;
  }
  table.units_in_round_brackets =
      units != nullptr && std::ranges::all_of(units->cells, [](const auto& c) {
        return c.empty() || c.front() == '(';
      });
  return table;
}

std::optional<Table> recognise_bluehill(const Preview& preview) {
  std::optional<Table> table = recognise_any_table(preview);
  if (!table || table->header_rows == 0 || !table->units_in_round_brackets) return std::nullopt;
  table->layout = "Bluehill raw data";
  return table;
}

}  // namespace havers::io
