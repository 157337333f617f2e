// Each `name_` function warns of one kind of doubt about the columns that were chosen. A column
// that the user has named is not doubted.
#include "io/machine/column_notes.hpp"

#include <fmt/format.h>

#include "io/input_error.hpp"
#include "io/machine/quantity.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

// What is only taken for want of better is said; a stress counts for nothing beside a force.
void name_doubts(TestFile& file, const ReadOptions& options, const Chosen& chosen) {
  for (const auto& [quantity, i] : chosen) {
    const std::string_view doubt = doubt_of(file.columns[i].name, dimension_of(file.columns[i]));
    const bool spare = quantity == Quantity::stress && chosen.contains(Quantity::force);
    if (doubt.empty() || spare || options.columns.contains(quantity)) continue;
    file.test.warnings.push_back(fmt::format(
        "column \"{}\" is used for want of a better one: it is {}", file.columns[i].name, doubt));
  }
}

// A name that says nothing leaves the choice to the unit.
void name_guesses(TestFile& file, const ReadOptions& options, const Chosen& chosen) {
  for (const auto& [quantity, i] : chosen) {
    const Column& column = file.columns[i];
    if (quantity_of_name(column.name) != Quantity::other || options.columns.contains(quantity))
      continue;
    file.test.warnings.push_back(fmt::format(
        "column \"{}\" is taken as {} by its unit alone ({} takes another)", column.name,
        to_string(quantity), column_setting(options, to_string(quantity), "...")));
  }
}

// A unit of another quantity than the name's is believed, and said where it decides: where the
// column is taken by it, or what the name speaks of is missing.
void name_contradictions(TestFile& file, const ReadOptions& options, const Chosen& chosen) {
  for (std::size_t i = 0; i < file.columns.size(); ++i) {
    const Column& column = file.columns[i];
    const Quantity named = quantity_of_name(column.name), held = column.quantity;
    if (named == Quantity::other || held == Quantity::other || held == named ||
        held == in_volts(named) || options.columns.contains(held) ||
        is_crosshead_strain(column.name, dimension_of(column)))
      continue;
    if (chosen.contains(named) && chosen.at(held) != i) continue;
    file.test.warnings.push_back(fmt::format(
        R"(column "{}" is {} by its name and {} by its unit, {}: the unit is believed ({} corrects it))",
        column.name, to_string(named), to_string(held), column.unit,
        column_setting(options, to_string(key_of(named)) + "_unit", "...")));
  }
}

// Without a strain, what may be one by its unit.
void name_unread(TestFile& file, const ReadOptions& options, const Chosen& chosen) {
  if (chosen.contains(Quantity::strain) || chosen.contains(Quantity::volts)) return;
  for (std::size_t i = 0; i < file.columns.size(); ++i) {
    const Column& column = file.columns[i];
    if (column.quantity == Quantity::other && !is_no_reading(column.name) &&
        dimension_of(column) == Dimension::strain)
      file.test.warnings.push_back(fmt::format(
          "column \"{}\" in {} is not read: its name says no strain ({} takes it for one)",
          column.name, column.unit, column_setting(options, "strain", std::to_string(i + 1))));
  }
}

// A column whose unit is not known is not used: an error where the load is lost by it.
void name_unknown_units(TestFile& file, const std::string& where, const ReadOptions& options,
                        const Chosen& chosen) {
  // A logger needs no load.
  const bool loaded = options.logger || chosen.contains(Quantity::force) ||
                      chosen.contains(Quantity::stress) || chosen.contains(Quantity::load_volts);
  for (const Column& column : file.columns) {
    const Quantity named = quantity_of_name(column.name);
    if (named == Quantity::other || column.unit.empty() || find_unit(column.unit) ||
        chosen.contains(named) || column.quantity != Quantity::other)
      continue;
    if (!loaded && (named == Quantity::force || named == Quantity::stress))
      throw InputError(where, unknown_unit(column), unit_hint_of(named, options));
    file.test.warnings.push_back(
        fmt::format("{}: not used ({})", unknown_unit(column), unit_hint_of(named, options)));
  }
}

}  // namespace

void note_columns(TestFile& file, const std::string& where, const ReadOptions& options,
                  const Chosen& chosen) {
  name_doubts(file, options, chosen);
  name_guesses(file, options, chosen);
  name_contradictions(file, options, chosen);
  name_unread(file, options, chosen);
  name_unknown_units(file, where, options, chosen);
}

}  // namespace havers::io
