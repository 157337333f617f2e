// What the user says of the columns is checked here: a column that does not exist, or a unit of
// another quantity, is refused rather than passed over.
#include "io/machine/column_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <vector>

#include "io/input_error.hpp"
#include "io/machine/excerpt.hpp"
#include "io/machine/quantity.hpp"
#include "io/machine/split_unit.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

// The user's word for a column: its name in the file, or its number from 1.
std::optional<std::size_t> hinted_column(const std::string& hint,
                                         const std::vector<Column>& columns) {
  // The name first: a column may be called "2".
  const auto found = std::ranges::find(columns, hint, &Column::name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  const NameAndUnit written = split_unit(hint);  // "force_kN" was split as the file was read
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == written.name && columns[i].unit == written.unit) return i;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(hint.data(), hint.data() + hint.size(), number);
  const bool whole = error == std::errc{} && end == hint.data() + hint.size();
  if (!whole || number < 1 || number > columns.size()) return std::nullopt;
  return number - 1;
}

// What a column in that unit holds: a force or a strain in volts waits for its factor. Nothing
// where the unit is none of the quantity.
std::optional<Quantity> held_in(const std::string& unit, Quantity quantity) {
  const std::optional<Unit> known = find_unit(unit);
  if (!known) return std::nullopt;
  if (fits(quantity, known->dimension)) return quantity;
  const bool by_factor = quantity == Quantity::force || quantity == Quantity::strain;
  if (by_factor && known->dimension == Dimension::voltage) return in_volts(quantity);
  return std::nullopt;
}

InputError wrong_unit(const std::string& where, const std::string& unit, Quantity quantity) {
  return {where, fmt::format("\"{}\" is not a known unit of {}", unit, to_string(quantity)),
          fmt::format("{}_unit may be {}", to_string(quantity), info_of(quantity).usual_units)};
}

}  // namespace

Quantity in_volts(Quantity quantity) {
  return quantity == Quantity::force ? Quantity::load_volts : Quantity::volts;
}

std::string list_of(const std::vector<Column>& columns) {
  // A message stays a sentence, however many columns there are.
  constexpr std::size_t most = 20;
  std::string text;
  for (const Column& column : std::span(columns).first(std::min(columns.size(), most)))
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", excerpt(column.name),
                        column.unit.empty() ? "" : " (" + excerpt(column.unit) + ")");
  return columns.size() > most ? text + ", ..." : text;
}

std::string column_setting(const ReadOptions& options, std::string_view key,
                           std::string_view value) {
  const std::string_view table = options.logger ? "gauge_columns" : "columns";
  return options.alone ? fmt::format("--set {}.{}={}", table, key, value)
                       : fmt::format("{} = {} in [specimen.{}]", key, value, table);
}

std::string column_place(const ReadOptions& options) {
  const std::string_view table = options.logger ? "gauge_columns" : "columns";
  return options.alone ? fmt::format("by --set {}.KEY=VALUE", table)
                       : fmt::format("in [specimen.{}]", table);
}

Quantity key_of(Quantity quantity) {
  if (quantity == Quantity::load_volts) return Quantity::force;
  return quantity == Quantity::volts ? Quantity::strain : quantity;
}

std::string unknown_unit(const Column& column) {
  return fmt::format(R"(unit "{}" of column "{}" is not known)", excerpt(column.unit),
                     excerpt(column.name));
}

std::string unit_hint_of(Quantity quantity, const ReadOptions& options) {
  return "say " + column_setting(options, to_string(quantity) + "_unit", "...");
}

void take_units(TestFile& file, const std::string& where, const ReadOptions& options) {
  for (const auto& [quantity, unit] : options.units) {
    if (!held_in(unit, quantity)) throw wrong_unit(where, unit, quantity);
    // A single column takes the unit whatever its own is; of several, those whose own is not known.
    std::vector<Column*> named;
    for (Column& column : file.columns)
      if (quantity_of_name(column.name) == quantity) named.push_back(&column);
    if (named.empty())
      throw InputError(
          where,
          fmt::format("no column's name speaks of {0}, but {0}_unit is given", to_string(quantity)),
          fmt::format("say {}; the columns are {}",
                      column_setting(options, to_string(quantity), "..."), list_of(file.columns)));
    if (named.size() > 1)  // meant are those that need it
      std::erase_if(named,
                    [](const Column* column) { return find_unit(column->unit).has_value(); });
    if (named.empty())
      throw InputError(
          where,
          fmt::format("several columns speak of {0}, and {0}_unit does not say which "
                      "it is of",
                      to_string(quantity)),
          fmt::format("say {} too; the columns are {}",
                      column_setting(options, to_string(quantity), "..."), list_of(file.columns)));
    for (Column* column : named) column->unit = unit;
  }
}

Chosen take_hints(TestFile& file, const std::string& where, const ReadOptions& options) {
  Chosen chosen;
  for (const auto& [quantity, hint] : options.columns) {
    const std::optional<std::size_t> found = hinted_column(hint.column, file.columns);
    if (!found)
      throw InputError(where, fmt::format(R"(there is no column "{}")", hint.column),
                       "the columns are " + list_of(file.columns));
    Column& column = file.columns[*found];
    if (!hint.unit.empty()) column.unit = hint.unit;
    const std::optional<Quantity> held = held_in(column.unit, quantity);
    // The user's unit must be one of the quantity. The file's is refused only where it is a known
    // one of another quantity; an unknown or missing one is judged in `find_channels`.
    if (!held && !hint.unit.empty()) throw wrong_unit(where, hint.unit, quantity);
    if (!held && find_unit(column.unit))
      throw InputError(
          where,
          fmt::format("column \"{}\" is in {}, which is no unit of {}", excerpt(column.name),
                      excerpt(column.unit), to_string(quantity)),
          "name another, or say " + column_setting(options, to_string(quantity) + "_unit", "..."));
    // For a unit in volts this is `volts` or `load_volts`.
    column.quantity = held.value_or(quantity);
    chosen[column.quantity] = *found;
  }
  return chosen;
}

}  // namespace havers::io
