// Every column is classified: which quantity its name and unit allow, and with what rank, which
// says how sure that is. The user's columns are set first; the others are then taken rank by rank,
// so that a better column counts wherever it stands.
#include "io/machine/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "io/input_error.hpp"
#include "io/machine/column_hints.hpp"
#include "io/machine/column_notes.hpp"
#include "io/machine/fact_names.hpp"
#include "io/machine/quantity.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

// Percent and mm/mm are units of too many things to stand for a strain, but for a gauge's.
Quantity quantity_of_unit(const Column& column) {
  const std::optional<Unit> known = find_unit(column.unit);
  if (!known) return Quantity::other;
  if (known->dimension == Dimension::strain && quantity_of_name(column.name) == Quantity::other &&
      (is_of_strain_alone(*known) || is_of_sensor(column.name)))
    return Quantity::strain;
  for (const Quantity quantity :
       {Quantity::time, Quantity::force, Quantity::extension, Quantity::stress, Quantity::volts})
    if (fits(quantity, known->dimension)) return quantity;
  return Quantity::other;
}

// "Microstrain" is a name and a unit.
std::string unit_of(const Table& table, std::size_t i) {
  const std::optional<Unit> named = find_unit(table.names[i]);
  const bool is_unit = table.units[i].empty() && named && is_of_strain_alone(*named);
  return is_unit ? table.names[i] : table.units[i];
}

// What a column may be; the smaller the rank, the sooner it is taken. The column of a gauge, an
// extensometer or a load cell beats any other of its quantity; a strain by its unit alone beats one
// that is doubted, as one of the crosshead; any other unit alone comes last.
struct Candidate {
  Quantity quantity = Quantity::other;
  int rank = 0;
};
enum Rank { of_sensor, by_name, by_unit_of_strain, in_doubt, by_unit, ranks };

// The name decides where the unit allows it or is missing; else the unit does. Nothing where the
// name is that of no reading, as a command or a peak, or of a fact of the specimen.
Candidate classify(const Column& column) {
  if (is_no_reading(column.name) || fact_of_key(column.name)) return {};
  const Quantity named = quantity_of_name(column.name);
  const std::optional<Unit> unit = find_unit(column.unit);
  const Rank rank = !doubt_of(column.name, dimension_of(column)).empty() ? in_doubt
                    : is_of_sensor(column.name)                          ? of_sensor
                                                                         : by_name;
  if (named != Quantity::other && column.unit.empty()) return {named, rank};
  if (named != Quantity::other && unit && fits(named, unit->dimension)) return {named, rank};
  // An "Extension" in percent.
  if (named == Quantity::extension && is_crosshead_strain(column.name, dimension_of(column)))
    return {Quantity::strain, rank};
  // A signal whose factor is not known may still become a force or a strain (X19).
  if (unit && unit->dimension == Dimension::voltage) return {in_volts(named), by_unit};
  const Quantity held = quantity_of_unit(column);
  return {held, held == Quantity::strain ? by_unit_of_strain : by_unit};
}

// The length by which an elongation of the gauge is divided: the user's, else the extensometer's
// own, else the specimen's.
std::optional<double> gauge_length_of(const calib::RawTest& test, const ReadOptions& options) {
  const bool own = test.extensometer_length && !options.gauge_length;
  return own ? test.extensometer_length : test.gauge_length;
}

std::string without_gauge_length(const Column& column) {
  return fmt::format("column \"{}\" is an elongation, and the gauge length is unknown",
                     column.name);
}

// Factor to SI of what is to hold `quantity`; the warnings say what was assumed. An elongation's
// factor makes a strain of it.
double factor(const Column& column, Quantity quantity, const std::string& where,
              const ReadOptions& options, calib::RawTest& test) {
  const std::string_view assumed = info_of(column.quantity).assumed_unit;
  const std::optional<Unit> unit = find_unit(column.unit.empty() ? assumed : column.unit);
  if (!unit) throw InputError(where, unknown_unit(column), unit_hint_of(column.quantity, options));
  if (column.unit.empty()) test.warnings.push_back(without_unit(column, assumed));
  if (quantity == Quantity::strain && unit->dimension == Dimension::length) {
    const std::optional<double> length = gauge_length_of(test, options);
    if (!length) throw InputError(where, without_gauge_length(column), "say gauge_length_mm");
    if (!test.extensometer_length && !options.gauge_length)
      test.warnings.push_back(fmt::format(
          "column \"{}\" is an elongation, divided by the gauge length, {:g} mm: of an "
          "extensometer of another length the strain is wrong (gauge_length_mm says it)",
          column.name, *length * 1e3));
    constexpr double rounding = 0.01;
    if (test.extensometer_length && std::abs(*test.extensometer_length / *length - 1.0) > rounding)
      test.warnings.push_back(fmt::format(
          "column \"{}\" is an elongation, divided by the given gauge length, {:g} mm, and the "
          "file says that its extensometer has {:g} mm: without gauge_length_mm that one counts",
          column.name, *length * 1e3, *test.extensometer_length * 1e3));
    return unit->to_si / *length;
  }
  return unit->to_si;
}

// Tension is positive here, whatever the column counts. Time has no sign, whatever its name.
double signed_factor(const Column& column, Quantity quantity, const std::string& where,
                     const ReadOptions& options, calib::RawTest& test) {
  const double to_si = factor(column, quantity, where, options, test);
  if (column.quantity == Quantity::time || !counts_compression(column.name)) return to_si;
  test.warnings.push_back(fmt::format(
      "column \"{}\" counts compression, by its name: its sign is turned", column.name));
  return -to_si;
}

// An elongation of the gauge is a strain only where its length is known.
bool is_usable(const Column& column, const calib::RawTest& test, const ReadOptions& options) {
  const std::optional<Unit> unit = find_unit(column.unit);
  return column.quantity != Quantity::strain || !unit || unit->dimension == Dimension::strain ||
         gauge_length_of(test, options).has_value();
}

// What else could have been taken, and how.
std::string other_choice(const TestFile& file, std::size_t taken, std::size_t other,
                         const ReadOptions& options) {
  const Column& column = file.columns[other];
  return fmt::format(
      R"(columns "{}" and "{}" both hold {}: "{}" is used ({} takes the other))",
      file.columns[taken].name, column.name, to_string(column.quantity), file.columns[taken].name,
      column_setting(options, to_string(key_of(column.quantity)), std::to_string(other + 1)));
}

// The one other gauge of the same kind; of three or more none tells which face it is on, and
// beside a second load it is another bar's.
std::optional<std::size_t> second_gauge(const TestFile& file,
                                        const std::vector<Candidate>& candidates,
                                        const ReadOptions& options, const Chosen& chosen) {
  const auto first = chosen.find(Quantity::strain);
  if (first == chosen.end() || options.columns.contains(Quantity::strain)) return std::nullopt;
  const std::size_t i = first->second;
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (k != i && candidates[k].quantity == Quantity::strain && candidates[i].rank != in_doubt &&
        candidates[k].rank == candidates[i].rank &&
        dimension_of(file.columns[k]) == dimension_of(file.columns[i]) &&
        are_alike(file.columns[k].name, file.columns[i].name))
      found.push_back(k);
  std::vector<std::size_t> loads;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (candidates[k].quantity == Quantity::force) loads.push_back(k);
  const bool two_bars = std::ranges::any_of(loads, [&](std::size_t k) {
    return are_alike(file.columns[k].name, file.columns[loads.front()].name);
  });
  return found.size() == 1 && !two_bars ? std::optional(found.front()) : std::nullopt;
}

// The best columns first; a second column of a quantity is not used, and that is said unless the
// user has chosen.
void choose(TestFile& file, const std::vector<Candidate>& candidates, const ReadOptions& options,
            Chosen& chosen) {
  // The user's columns keep what they were chosen for, and of a quantity that the user has chosen
  // no other column is mentioned.
  const Chosen hinted = chosen;
  for (int rank = of_sensor; rank < ranks; ++rank) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      Column& column = file.columns[i];
      const bool taken =
          std::ranges::any_of(hinted, [&](const auto& entry) { return entry.second == i; });
      if (taken || candidates[i].rank != rank) continue;
      column.quantity = candidates[i].quantity;
      if (column.quantity == Quantity::other) continue;
      if (!is_usable(column, file.test, options))
        file.test.warnings.push_back(without_gauge_length(column) + ": not used");
      else if (const auto [first, fresh] = chosen.try_emplace(column.quantity, i);
               !fresh && !hinted.contains(column.quantity) &&
               (column.quantity != Quantity::strain ||
                second_gauge(file, candidates, options, chosen) != i))
        file.test.warnings.push_back(other_choice(file, first->second, i, options));
    }
  }
}

// How the user gives the factor of a load in volts.
const char* volt_hint(const ReadOptions& options) {
  return options.alone ? "say what a volt is, as in --set columns.force_unit='500 N/V'"
                       : "say what a volt is in [specimen.columns], as in force_unit = \"500 N/V\"";
}

// A test needs a load. One in volts is kept where a logger's force may tell its factor (X19). Other
// signals in volts are dropped with a warning beside that or a load, and refused without. Where
// nothing at all was recognised, the refusal shows a guess from the numbers.
void need_load(TestFile& file, const Table& table, const ReadOptions& options, Chosen& chosen) {
  const std::string where = at_line(file.file, table.first_line);
  const bool loaded = chosen.contains(Quantity::force) || chosen.contains(Quantity::stress);
  const bool fitted = !loaded && options.has_logger && chosen.contains(Quantity::load_volts);
  for (const Quantity quantity : {Quantity::load_volts, Quantity::volts}) {
    const auto volts = chosen.find(quantity);
    if (volts == chosen.end() || (fitted && quantity == Quantity::load_volts)) continue;
    const std::string what =
        fmt::format("column \"{}\" is in volts", file.columns[volts->second].name);
    if (!loaded && !fitted) throw InputError(where, what, volt_hint(options));
    file.test.warnings.push_back(fmt::format("{}: not used ({})", what, volt_hint(options)));
    chosen.erase(volts);
  }
  if (loaded || fitted) return;
  throw InputError(
      where, "no column holds a force or a stress",
      fmt::format("the columns are {}; name it {}{}", list_of(file.columns), column_place(options),
                  chosen.empty() && !table.guess.empty()
                      ? "; from the numbers it may be " + table.guess
                      : ""));
}

// A logger's file needs a time, by which its clock is matched, and a signal that goes along with
// the test: a strain, volts, a force or an extension.
void need_gauge(const TestFile& file, const std::string& where, const ReadOptions& options,
                const Chosen& chosen) {
  for (const Column& column : file.columns)
    if (column.quantity == Quantity::strain && !is_usable(column, file.test, options))
      throw InputError(where, without_gauge_length(column), "say gauge_length_mm");
  const bool measures = std::ranges::any_of(chosen, [](const auto& entry) {
    return entry.first != Quantity::time && entry.first != Quantity::stress;
  });
  if (chosen.contains(Quantity::time) && measures) return;
  throw InputError(
      where, "a logger's file needs a time and a gauge",
      "the columns are " + list_of(file.columns) + "; name them " + column_place(options));
}

// A logger's extension is that of its gauge: a strain where the user or the file tells the gauge's
// length. Without one the machine's file may tell it.
void take_gauges_extension(const TestFile& file, const ReadOptions& options, Chosen& chosen) {
  if (chosen.contains(Quantity::strain) || !gauge_length_of(file.test, options)) return;
  if (auto extension = chosen.extract(Quantity::extension)) {
    extension.key() = Quantity::strain;
    chosen.insert(std::move(extension));
  }
}

}  // namespace

std::string without_unit(const Column& column, std::string_view assumed) {
  return fmt::format("column \"{}\" has no unit, taken as {}", column.name, assumed);
}

std::vector<Channel> find_channels(TestFile& file, const Table& table, const ReadOptions& options) {
  const std::string where = at_line(file.file, table.first_line);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < table.names.size(); ++i)
    file.columns.push_back({table.names[i], unit_of(table, i)});
  // The user's units count as the file's, so they are set before columns are classified by them;
  // the user's columns are set afterwards, and overrule the classification.
  take_units(file, where, options);
  std::ranges::transform(file.columns, std::back_inserter(candidates), classify);
  Chosen chosen = take_hints(file, where, options);
  choose(file, candidates, options, chosen);
  note_columns(file, where, options, chosen);
  if (options.logger) {
    need_gauge(file, where, options, chosen);
    take_gauges_extension(file, options, chosen);
  } else {
    need_load(file, table, options, chosen);
  }
  // (X2) The machine's compliance is in a strain of the crosshead, unless the user names it as the
  // strain.
  if (const auto strain = chosen.find(Quantity::strain); strain != chosen.end()) {
    const Column& column = file.columns[strain->second];
    file.test.crosshead_strain = !options.columns.contains(Quantity::strain) &&
                                 is_crosshead_strain(column.name, dimension_of(column));
  }
  // In the order of Quantity: time comes first where there is one.
  std::vector<Channel> channels;
  for (const auto& [quantity, column] : chosen)
    channels.push_back({quantity, table.first_column + column, column,
                        signed_factor(file.columns[column], quantity, where, options, file.test)});
  if (const auto i = second_gauge(file, candidates, options, chosen))
    channels.push_back(
        {Quantity::strain, table.first_column + *i, *i,
         signed_factor(file.columns[*i], Quantity::strain, where, options, file.test), true});
  return channels;
}

}  // namespace havers::io
