#include "io/results/csv_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include "io/input_error.hpp"
#include "io/machine/csv_rows.hpp"
#include "io/machine/excerpt.hpp"
#include "io/read_text.hpp"

namespace havers::io {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // as Excel's "CSV UTF-8" has it

// Takes rows one by one: the header first, then numbers. All faults of a file are collected and
// said at once; but a header that lacks columns ends the reading.
class Columns {
 public:
  Columns(std::string file, const std::vector<std::string>& names, std::size_t optional)
      : file_(std::move(file)),
        names_(names),
        needed_(std::ssize(names) - static_cast<std::ptrdiff_t>(optional)) {}

  bool take(const Row& row) {
    if (positions_.empty()) return find_columns(row);
    if (row.cells.size() > cells_)
      problems_.push_back({at_line(file_, row.line),
                           fmt::format("has {} cells, the header has {}", row.cells.size(), cells_),
                           "is the decimal mark also the delimiter?"});
    CsvNumbers numbers{row.line, {}};
    for (std::size_t i = 0; i < names_.size(); ++i) numbers.values.push_back(number(row, i));
    rows_.push_back(std::move(numbers));
    return true;
  }

  std::vector<CsvNumbers> finish() {
    if (positions_.empty() && problems_.empty())
      problems_.push_back({file_, "is empty", expected()});
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::string expected() const {
    return fmt::format("the columns needed are {}",
                       fmt::join(names_.begin(), std::next(names_.begin(), needed_), ","));
  }

  // A missing name gets the position behind the last cell, where `number` finds nothing.
  bool find_columns(const Row& header) {
    cells_ = header.cells.size();
    // With another delimiter every column would be missing; the delimiter is named instead.
    if (cells_ == 1 && header.cells[0].find_first_of(";\t|") != std::string_view::npos) {
      problems_.push_back({at_line(file_, header.line),
                           fmt::format("has one column, \"{}\"", excerpt(header.cells[0])),
                           "separate cells by commas, and write decimals with a point"});
      return false;
    }
    for (const std::string& name : names_) {
      const auto found = std::ranges::find(header.cells, name);
      if (found == header.cells.end() && std::ssize(positions_) < needed_)
        problems_.push_back(
            {at_line(file_, header.line), fmt::format("has no column {}", name), expected()});
      positions_.push_back(static_cast<std::size_t>(found - header.cells.begin()));
    }
    return problems_.empty();
  }

  double number(const Row& row, std::size_t column) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const std::size_t position = positions_[column];
    const std::string_view cell = position < row.cells.size() ? row.cells[position] : "";
    const char* const end = cell.data() + cell.size();
    // Unlike a testing machine's file, this one may have no thousands marks and no decimal comma.
    const bool whole = std::from_chars(cell.data(), end, value).ptr == end;
    if (!cell.empty() && !(whole && std::isfinite(value)))
      problems_.push_back(
          {at_line(file_, row.line),
           fmt::format("column {} holds \"{}\", must be a number", names_[column], excerpt(cell)),
           ""});
    return value;
  }

  std::string file_;
  const std::vector<std::string>& names_;
  std::ptrdiff_t needed_;               // of the names; the others may be missing
  std::vector<std::size_t> positions_;  // of each name in the header
  std::size_t cells_ = 0;               // of the header
  std::vector<CsvNumbers> rows_;
  std::vector<Problem> problems_;
};

}  // namespace

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value + 0.0) : "";  // -0 + 0 is 0
}

std::string csv_text(const std::vector<std::string>& header,
                     const std::vector<std::vector<double>>& columns) {
  std::string text = fmt::format("{}\n", fmt::join(header, ","));
  for (std::size_t row = 0; row < columns.front().size(); ++row)
    for (std::size_t i = 0; i < columns.size(); ++i)
      text += csv_number(columns[i][row]) + (i + 1 < columns.size() ? "," : "\n");
  return text;
}

std::vector<CsvNumbers> read_csv_numbers(const std::filesystem::path& file,
                                         const std::vector<std::string>& names,
                                         std::size_t optional) {
  Columns columns(file.string(), names, optional);
  CsvRows rows(',', [&](const Row& row) { return columns.take(row); });
  const std::string text = read_text(file, "a CSV file with a header row is expected there");
  rows.feed(std::string_view(text).substr(text.starts_with(byte_order_mark) ? byte_order_mark.size()
                                                                            : 0));
  if (const std::size_t line = rows.open_quote_line(); line > 0)
    throw InputError(at_line(file.string(), line), "a quote is opened and not closed");
  rows.finish();
  return columns.finish();
}

}  // namespace havers::io
