// Rows are taken as numbers until a text stands where the first channel should be. From there rows
// are held back as a possible header, which two rows of numbers end. It then turns out to begin a
// further specimen or a further page of the same one, or to be a fault.
#include "io/machine/specimen_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/experiment/gauge_pair.hpp"
#include "calib/experiment/lost_gauge.hpp"
#include "io/machine/column_hints.hpp"
#include "io/machine/excerpt.hpp"
#include "io/machine/fact_names.hpp"
#include "io/machine/facts.hpp"
#include "io/machine/number.hpp"
#include "io/machine/quantity.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

// A file that is wrong in every row need not say so in every row.
constexpr std::size_t enough_problems = 5;
constexpr std::size_t longest_header = 500;  // rows that are held back at most

// The machine's stress must be force over the area that the file states, or one of the three is
// wrong.
void check_stress(calib::RawTest& test) {
  const bool has_sizes = test.width && test.thickness;
  if (test.force.empty() || test.stress.empty() || (!has_sizes && !test.area)) return;
  const double area = has_sizes ? *test.width * *test.thickness : *test.area;
  double largest_stress = 0.0, largest_difference = 0.0;
  for (std::size_t i = 0; i < test.force.size(); ++i) {
    largest_stress = std::max(largest_stress, std::abs(test.stress[i]));
    largest_difference =
        std::max(largest_difference, std::abs(test.force[i] / area - test.stress[i]));
  }
  constexpr double tolerance = 0.01;
  if (largest_difference > tolerance * largest_stress)
    test.warnings.push_back(
        fmt::format("the stress column differs from force / {0} by up to {1:.3g} MPa of {2:.4g} "
                    "MPa: the force is used, check {3}",
                    has_sizes ? "(width × thickness)" : "area", largest_difference * 1e-6,
                    largest_stress * 1e-6, has_sizes ? "width and thickness" : "the area"));
}

// The header of a specimen beside others: where its own columns begin with a key, that and what
// follows it; what stands left of all is of all.
std::vector<PreviewRow> header_of(const Table& part, std::span<const PreviewRow> header) {
  std::vector<PreviewRow> own(header.begin(), header.end());
  if (part.first_column == 0) return own;
  for (PreviewRow& row : own)
    if (row.cells.size() > part.first_column + 1 && fact_of_key(row.cells[part.first_column]))
      row.cells.erase(row.cells.begin(),
                      row.cells.begin() + static_cast<std::ptrdiff_t>(part.first_column));
  return own;
}

// Sizes that are there before the header is read stay (`read_facts`).
void take_given_sizes(const ReadOptions& options, calib::RawTest& test) {
  test.width = options.width;
  test.thickness = options.thickness;
  test.gauge_length = options.gauge_length;
}

// A spreadsheet's date and time as a number, in days: as of a clock's time the date is left out. In
// seconds the record would begin hours after zero and be over within one; the limits are the years
// 1954 and, of those who count from the year 0, 2737.
void take_serial_dates(TestFile& file, const Column& column, const ReadOptions& options) {
  constexpr double earliest = 2e4, latest = 1e6, day = 86400.0;
  std::vector<double>& time = file.test.time;
  if (!column.unit.empty() || time.front() < earliest || time.front() > latest ||
      time.back() - time.front() >= 1.0)
    return;
  const double date = std::floor(time.front());
  for (double& value : time) value = day * (value - date);
  std::ranges::replace(
      file.test.warnings, without_unit(column, info_of(Quantity::time).assumed_unit),
      without_unit(column, fmt::format("days, as a spreadsheet counts dates ({} takes seconds)",
                                       column_setting(options, "time_unit", "\"s\""))));
}

// What was made of a second gauge, and how one is taken alone.
void join_second_gauge(TestFile& file, std::span<const Channel> channels,
                       const std::vector<double>& values, const ReadOptions& options) {
  const std::size_t i = std::ranges::find(channels, Quantity::strain, &Channel::quantity)->in_file,
                    k = channels.back().in_file;
  const std::string &a = file.columns[i].name, &b = file.columns[k].name;
  file.test.warnings.push_back(
      fmt::format(R"(columns "{}" and "{}" both hold strain: {} ({} or {} takes one alone))", a, b,
                  calib::join_gauge_pair(file.test, values, a, b),
                  column_setting(options, "strain", std::to_string(i + 1)), k + 1));
}

}  // namespace

InputError open_quote(const std::string& file, std::size_t line) {
  return {at_line(file, line), "a quote is opened and never closed",
          "the file may be cut off or damaged here"};
}

SpecimenTables::SpecimenTables(TestFile common, Dialect dialect, const ReadOptions& options)
    : common_(std::move(common)), dialect_(std::move(dialect)), options_(options) {}

void SpecimenTables::begin(const Table& table, std::span<const PreviewRow> header) {
  current_ = specimens_.size();
  first_line_ = table.first_line;
  for (const Table& part : side_by_side(table)) {
    SpecimenColumns& specimen = specimens_.emplace_back();
    specimen.file = common_;
    specimen.file.number = specimens_.size();
    specimen.file.layout = table.layout;
    take_given_sizes(options_, specimen.file.test);
    read_facts(header_of(part, header), specimen.file.test);
    // A title above the specimen's own columns counts before a line of the header.
    if (!part.title.empty()) specimen.file.test.specimen_id = part.title;
    specimen.channels = find_channels(specimen.file, part, options_);
    specimen.values.resize(specimen.channels.size());
  }
}

void SpecimenTables::read(std::string_view beginning, TextSource& source) {
  CsvRows rows = rows_of(dialect_, [this](const Row& row) { return take_row(row); });
  bool wanted = rows.feed(beginning);
  if (wanted) make_room(source.first_blocks());
  while (wanted) {
    const std::string_view block = source.next();
    wanted = !block.empty() && rows.feed(block);
  }
  // An open quote hides the rows after it. Faults found before it are reported instead.
  if (const std::size_t line = rows.open_quote_line(); line > 0 && problems_.empty())
    throw open_quote(common_.file, line);
  rows.finish();
  if (!header_.empty()) end_file();
  if (!problems_.empty()) throw InputError(std::move(problems_));
}

// As many rows in every block as in the first: a vector that grows by doubling copies all it has.
void SpecimenTables::make_room(double blocks) {
  constexpr double spare = 1.05;
  for (SpecimenColumns& specimen : current())
    for (std::vector<double>& values : specimen.values)
      values.reserve(static_cast<std::size_t>(spare * blocks * static_cast<double>(values.size())));
}

bool SpecimenTables::take_row(const Row& row) {
  // The names and what stands above them were read from the preview.
  if (row.line < first_line_) return true;
  const bool empty = row.cells[0].empty() &&
                     std::ranges::all_of(row.cells, [](auto cell) { return cell.empty(); });
  // A row of delimiters alone counts as a blank line.
  if (empty) return true;
  if (!header_.empty() || begins_header(row))
    take_header_row(row);
  else
    take_numbers(row, dialect_.decimal, current(), problems_);
  return problems_.size() < enough_problems;
}

// Text where the first channel should be: the header of a further specimen, if a table follows.
bool SpecimenTables::begins_header(const Row& row) const {
  const std::size_t column = specimens_[current_].channels.front().column;
  const std::string_view cell = row.cells[std::min(column, row.cells.size() - 1)];
  // A cell that begins with a digit is a clock's time or a faulty number, not a header.
  if (cell.empty() || (cell.front() >= '0' && cell.front() <= '9')) return false;
  return parse_number(cell, dialect_.decimal).fault == NumberFault::text;
}

void SpecimenTables::take_header_row(const Row& row) {
  header_.push_back({row.line, {row.cells.begin(), row.cells.end()}});
  // As for `recognise_table`, two rows of numbers of equal length begin a table.
  const auto is_numbers = [&](std::size_t from_end) {
    return header_.size() > from_end && is_number_row(header_[header_.size() - from_end], dialect_);
  };
  const bool two_rows = is_numbers(1) && is_numbers(2) &&
                        header_.end()[-1].cells.size() == header_.end()[-2].cells.size();
  if (two_rows || header_.size() >= longest_header) end_header();
}

// Whether its names speak of a quantity or a unit that is known, or are those of the table before.
bool SpecimenTables::names_a_specimen(const Table& table) const {
  const std::vector<Column>& before = specimens_[current_].file.columns;
  const auto speaks = [](const std::string& name) {
    return quantity_of_name(name) != Quantity::other;
  };
  const auto is_known = [](const std::string& unit) { return find_unit(unit).has_value(); };
  return std::ranges::any_of(table.names, speaks) || std::ranges::any_of(table.units, is_known) ||
         std::ranges::equal(table.names, before, {}, {}, &Column::name);
}

// What stands below the last numbers, and is none, sums up or says that the test has ended.
void SpecimenTables::end_file() {
  const auto is_numbers = [this](const PreviewRow& row) { return is_number_row(row, dialect_); };
  const auto is_letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<signed char>(c) < 0;
  };
  const std::string& first = header_.front().cells.front();
  if (std::ranges::any_of(header_, is_numbers) || std::ranges::none_of(first, is_letter))
    return end_header();
  for (SpecimenColumns& specimen : current())
    specimen.file.test.warnings.push_back(
        fmt::format("line {}, \"{}\", and what follows it are no rows of numbers: not read",
                    header_.front().line, excerpt(first)));
}

// As on every page of a printout: nothing but the same names, and time goes on.
bool SpecimenTables::goes_on(const Table& table, const Preview& preview) const {
  constexpr double longest_step = 3.0;  // over the one before
  const SpecimenColumns& specimen = specimens_[current_];
  const Channel& first = specimen.channels.front();
  const std::vector<double>& times = specimen.values.front();
  if (first.quantity != Quantity::time || times.size() < 2 || table.header_rows > 0 ||
      current_ + 1 < specimens_.size() ||
      !std::ranges::equal(table.names, specimen.file.columns, {}, {}, &Column::name))
    return false;
  const auto row = std::ranges::find(preview.rows, table.first_line, &PreviewRow::line);
  if (first.column >= row->cells.size()) return true;  // as any row that ends too early
  const Number next = read_cell(row->cells[first.column], preview.dialect.decimal, first);
  const double step = next.value - times.back(), before = times.back() - times.end()[-2];
  return next.fault == NumberFault::none && step >= 0.0 && step <= longest_step * before;
}

// A header that leads to no table of a specimen was a row of text among the numbers.
void SpecimenTables::end_header() {
  // The rows held back are looked at like the beginning of a file.
  const Preview preview{dialect_, std::exchange(header_, {})};
  const std::optional<Table> table = recognise_table(preview);
  if (!table || table->names.empty() || table->layout == results_layout ||
      !names_a_specimen(*table)) {
    const SpecimenColumns& specimen = specimens_[current_];
    const Channel& channel = specimen.channels.front();
    const PreviewRow& row = preview.rows.front();
    problems_.push_back(bad_cell(specimen.file, row.line, specimen.file.columns[channel.in_file],
                                 row.cells[std::min(channel.column, row.cells.size() - 1)],
                                 NumberFault::text));
    return;
  }
  if (!goes_on(*table, preview)) begin(*table, std::span(preview.rows).first(table->header_rows));
  take_held_back_numbers(preview.rows, table->first_line);
}

// Takes the rows of numbers that showed where the header ends.
void SpecimenTables::take_held_back_numbers(const std::vector<PreviewRow>& rows,
                                            std::size_t first_line) {
  for (const PreviewRow& row : rows) {
    if (row.line < first_line) continue;
    const std::vector<std::string_view> cells(row.cells.begin(), row.cells.end());
    take_numbers({row.line, cells}, dialect_.decimal, current(), problems_);
  }
}

std::vector<TestFile> SpecimenTables::take() {
  std::vector<TestFile> files;
  for (SpecimenColumns& specimen : specimens_) {
    TestFile& file = specimen.file;
    // `find_channels` puts a second gauge last.
    const bool pair = !specimen.channels.empty() && specimen.channels.back().second_gauge;
    for (std::size_t i = 0; i < specimen.channels.size(); ++i)
      if (!specimen.channels[i].second_gauge)
        file.test.*info_of(specimen.channels[i].quantity).channel = std::move(specimen.values[i]);
    if (!specimen.clock && !file.test.time.empty())  // time comes first
      take_serial_dates(file, file.columns[specimen.channels.front().in_file], options_);
    if (pair) join_second_gauge(file, specimen.channels, specimen.values.back(), options_);
    if (const std::string problem = calib::mend_lost_gauge(file.test); !problem.empty())
      throw InputError(file.file, problem, "give all rows a strain, or leave them out");
    file.rows = file.test.rows();
    file.specimens = specimens_.size();
    // With the user's sizes instead of the file's the machine's stress differs anyway.
    if (!options_.width && !options_.thickness) check_stress(file.test);
    files.push_back(std::move(file));
  }
  return files;
}

}  // namespace havers::io
