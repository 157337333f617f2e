#include "io/machine/read_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "io/input_error.hpp"
#include "io/machine/channels.hpp"
#include "io/machine/facts.hpp"
#include "io/machine/guess.hpp"
#include "io/machine/layout.hpp"
#include "io/machine/number_columns.hpp"
#include "io/machine/text_source.hpp"

namespace havers::io {
namespace {

Table find_table(const std::string& name, const Preview& preview) {
  if (std::optional<Table> table = recognise_table(preview)) return *table;
  if (preview.open_quote_line > 0) throw open_quote(name, preview.open_quote_line);
  throw InputError(name, "no rows of numbers were found in it",
                   "a test file has a row of column names and rows of two numbers or more");
}

// Columns without names are called by their numbers, once the user has said which is which.
void name_columns(Table& table, const std::string& name, const Preview& preview,
                  const ReadOptions& options) {
  if (!table.names.empty()) return;
  if (options.columns.empty())
    throw InputError(fmt::format("{}:{}", name, table.first_line), "the columns have no names",
                     "say which is which in [specimen.columns]; from the numbers it may be " +
                         guess_columns(preview, table));
  const auto first = std::ranges::find(preview.rows, table.first_line, &PreviewRow::line);
  for (std::size_t i = 0; i < first->cells.size(); ++i) {
    table.names.push_back(std::to_string(i + 1));
    table.units.emplace_back();
  }
}

std::vector<double>& channel_of(calib::RawTest& test, Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return test.time;
    case Quantity::extension:
      return test.extension;
    case Quantity::strain:
      return test.strain;
    case Quantity::stress:
      return test.stress;
    case Quantity::force:
    case Quantity::other:
      break;
  }
  return test.force;
}

// The machine's stress must be force over the area that the file states, or one of the three is
// wrong.
void check_stress(calib::RawTest& test) {
  if (test.force.empty() || test.stress.empty() || !test.width || !test.thickness) return;
  const double area = *test.width * *test.thickness;
  double largest_stress = 0.0, largest_difference = 0.0;
  for (std::size_t i = 0; i < test.force.size(); ++i) {
    largest_stress = std::max(largest_stress, std::abs(test.stress[i]));
    largest_difference =
        std::max(largest_difference, std::abs(test.force[i] / area - test.stress[i]));
  }
  constexpr double tolerance = 0.01;
  if (largest_difference > tolerance * largest_stress)
    test.warnings.push_back(
        fmt::format("the stress column differs from force / (width × thickness) by up to {:.3g} "
                    "MPa of {:.4g} MPa: "
                    "the force is used, check width and thickness",
                    largest_difference * 1e-6, largest_stress * 1e-6));
}

}  // namespace

std::string to_string(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return "time";
    case Quantity::force:
      return "force";
    case Quantity::extension:
      return "extension";
    case Quantity::strain:
      return "strain";
    case Quantity::stress:
      return "stress";
    case Quantity::other:
      return "other";
  }
  return "unknown";
}

TestFile read_test(const std::filesystem::path& file, const ReadOptions& options) {
  TextSource source(file);
  const std::string beginning(source.next());
  const Preview preview = make_preview(beginning);

  TestFile result;
  result.file = file.string();
  result.encoding = source.encoding();
  result.delimiter = preview.dialect.delimiter;
  result.decimal = preview.dialect.decimal;
  Table table = find_table(result.file, preview);
  result.layout = table.layout;
  name_columns(table, result.file, preview, options);
  read_facts(std::span(preview.rows).first(table.header_rows), preview.dialect.decimal,
             result.test);

  const std::vector<Channel> channels = find_channels(result, table, options);
  NumberColumns numbers(result, table.first_line, preview.dialect, channels);
  numbers.read(beginning, source);
  for (std::size_t i = 0; i < channels.size(); ++i)
    channel_of(result.test, channels[i].quantity) = numbers.take(i);
  result.rows = result.test.rows();
  check_stress(result.test);
  return result;
}

}  // namespace havers::io
