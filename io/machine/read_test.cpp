// The beginning of the file tells encoding, delimiter, decimal mark and table; then the whole is
// read in one pass, block by block. Where no table of a test is found, `find_table` says what is
// there instead.
#include "io/machine/read_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>

#include "io/input_error.hpp"
#include "io/machine/column_hints.hpp"
#include "io/machine/excerpt.hpp"
#include "io/machine/fact_names.hpp"
#include "io/machine/guess.hpp"
#include "io/machine/layout.hpp"
#include "io/machine/specimen_tables.hpp"
#include "io/machine/text_source.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

constexpr std::size_t most_columns = 10'000;

// Results with a label in the first column are no rows of numbers; their names tell.
bool names_results(const PreviewRow& row) {
  return std::ranges::count_if(row.cells, is_result) >= 2;
}

// A row of numbers with a text among them is more likely a fault in a table than no table at all.
void refuse_text_among_numbers(const std::string& name, const PreviewRow& row,
                               const Preview& preview) {
  if (const std::string* text = text_among_numbers(row, preview.dialect.decimal))
    throw InputError(at_line(name, row.line),
                     fmt::format("\"{}\" stands among numbers", excerpt(*text)),
                     "correct it, or leave its column out of the export");
}

// A row for each specimen: in a column of text their names.
bool lists_specimens(const Table& table, const Dialect& dialect) {
  return std::ranges::any_of(dialect.text_columns, [&](std::size_t i) {
    return i < table.names.size() && fact_of_key(table.names[i]).has_value();
  });
}

Table find_table(const std::string& name, const Preview& preview) {
  for (const PreviewRow& row : preview.rows)
    if (row.cells.size() > most_columns)
      throw InputError(at_line(name, row.line),
                       fmt::format("has more than {} columns", most_columns),
                       "a test has a row for each time and a column for each channel");
  std::optional<Table> table = recognise_table(preview);
  if (table && table->layout != results_layout && !lists_specimens(*table, preview.dialect))
    return *table;
  // Says what is there instead: results, an open quote, a text among numbers, or none of these.
  if (table || std::ranges::any_of(preview.rows, names_results))
    throw InputError(name, "is a table of results, a row for each specimen",
                     "export the raw data: time, force and extension row by row");
  if (preview.open_quote_line > 0) throw open_quote(name, preview.open_quote_line);
  for (const PreviewRow& row : preview.rows) refuse_text_among_numbers(name, row, preview);
  throw InputError(name, "no rows of numbers were found in it",
                   "a test file has a row of column names and rows of two numbers or more, "
                   "separated by commas, semicolons, tabs or |");
}

// Columns without names are called by their numbers, once the user has said which is which.
void name_columns(Table& table, const std::string& name, const Preview& preview,
                  const ReadOptions& options) {
  if (!table.names.empty()) return;
  const auto first = std::ranges::find(preview.rows, table.first_line, &PreviewRow::line);
  // The row above the numbers names no columns; it may be a row of numbers with a text among them.
  if (first != preview.rows.begin()) refuse_text_among_numbers(name, *std::prev(first), preview);
  if (options.columns.empty())
    throw InputError(at_line(name, table.first_line), "the columns have no names",
                     fmt::format("say which is which {}; from the numbers it may be {}",
                                 column_place(options), table.guess));
  for (std::size_t i = 0; i < first->cells.size(); ++i) {
    table.names.push_back(std::to_string(i + 1));
    table.units.emplace_back();
  }
}

// A blank and the specimen's name in quotes, to follow its number; empty where it has no name.
std::string name_of(const TestFile& test) {
  const std::string& name = test.test.specimen_id;
  return name.empty() ? "" : fmt::format(" \"{}\"", excerpt(name));
}

std::string list_of(const std::vector<TestFile>& tests) {
  std::string text;
  for (std::size_t i = 0; i < tests.size(); ++i)
    text += fmt::format("{}{}{}", i == 0 ? "" : ", ", tests[i].number, name_of(tests[i]));
  return text;
}

InputError not_one(const std::vector<TestFile>& tests, const std::string& what, const char* hint) {
  return {tests.front().file, what, hint + ("it holds " + list_of(tests))};
}

// A number that is not what the specimens call themselves is easily mistaken for a name.
void name_numbered(TestFile& test) {
  const std::string& name = test.test.specimen_id;
  if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos)
    test.test.warnings.push_back(fmt::format(
        "specimen_in_file = {} is the number of the specimen in the file: its name is \"{}\"",
        test.number, name));
}

// The specimen of that name or number; a text is taken as a number only for a specimen without a
// name. A choice that could mean two specimens is refused, with a list of all.
TestFile chosen_of(std::vector<TestFile> tests, const ReadOptions& options) {
  const bool numbered = options.specimen_number.has_value();
  const std::string wanted = numbered ? std::to_string(*options.specimen_number) : options.specimen;
  const auto is_named = [&](const TestFile& test) { return test.test.specimen_id == wanted; };
  const auto is_counted = [&](const TestFile& test) {
    return std::to_string(test.number) == wanted && (numbered || test.test.specimen_id.empty());
  };
  const auto of_name = std::ranges::find_if(tests, is_named);
  const auto of_number = std::ranges::find_if(tests, is_counted);
  const auto names = std::ranges::count_if(tests, is_named);
  if (of_number != tests.end() && (names == 0 || is_named(*of_number))) {
    if (names == 0) name_numbered(*of_number);
    return std::move(*of_number);
  }
  if (of_number != tests.end())
    throw not_one(tests,
                  fmt::format("{0} is the number of one specimen and another's name", wanted),
                  "a name stands in quotes; ");
  if (names > 1)
    throw not_one(tests, fmt::format("holds several specimens \"{}\"", wanted),
                  "say which by its number; ");
  if (names == 0)
    throw not_one(tests, fmt::format("holds no specimen {0}{1}{0}", numbered ? "" : "\"", wanted),
                  "");
  return std::move(*of_name);
}

}  // namespace

std::vector<TestFile> read_tests(const std::filesystem::path& file, const ReadOptions& options) {
  TextSource source(file);
  // A copy, as the block is valid only until the next call.
  const std::string beginning(source.next());
  const Preview preview = make_preview(beginning);

  TestFile common;
  common.file = file.string();
  common.encoding = source.encoding();
  common.delimiter = preview.dialect.delimiter;
  common.decimal = preview.dialect.decimal;
  Table table = find_table(common.file, preview);
  table.guess = guess_columns(preview, table);
  name_columns(table, common.file, preview, options);

  SpecimenTables specimens(std::move(common), preview.dialect, options);
  specimens.begin(table, std::span(preview.rows).first(table.header_rows));
  specimens.read(beginning, source);
  std::vector<TestFile> tests = specimens.take();
  if (options.specimen.empty() && !options.specimen_number) return tests;
  std::vector<TestFile> chosen;
  chosen.push_back(chosen_of(std::move(tests), options));
  return chosen;
}

TestFile read_test(const std::filesystem::path& file, const ReadOptions& options) {
  std::vector<TestFile> tests = read_tests(file, options);
  if (tests.size() > 1)
    throw InputError(
        file.string(), fmt::format("holds {} specimens", tests.size()),
        options.logger
            ? "a logger's file holds one"
            : fmt::format("say which by specimen_in_file, its name or number: {}", list_of(tests)));
  return std::move(tests.front());
}

}  // namespace havers::io
