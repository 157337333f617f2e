// Every delimiter is tried with either decimal mark, and the pair that makes the most rows of
// numbers is taken. Only where that gives fewer than two such rows, lines quoted as a whole are
// tried, and then columns of text: with each of these more lines pass for a row of numbers.
#include "io/machine/preview.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

#include "io/machine/number.hpp"

namespace havers::io {
namespace {

constexpr std::size_t preview_bytes = 1U << 16U;
// Of two that make as many rows of numbers the first counts.
constexpr std::array<char, 4> delimiters{',', ';', '\t', '|'};

// The text up to preview_bytes, without a line that is cut there, which would look like a short
// row.
std::string_view whole_lines(std::string_view text) {
  if (text.size() <= preview_bytes) return text;
  text = text.substr(0, preview_bytes);
  const std::size_t end = text.find_last_of("\r\n");
  return end == std::string_view::npos ? text : text.substr(0, end + 1);
}

Preview cut(std::string_view text, const Dialect& dialect) {
  Preview preview;
  preview.dialect = dialect;
  const auto take = [&](const Row& row) {
    // "sep=;" tells spreadsheets the delimiter, which is found without it.
    const bool names_delimiter = row.line == 1 && row.cells[0].starts_with("sep=");
    if (!names_delimiter) preview.rows.push_back({row.line, {row.cells.begin(), row.cells.end()}});
    return true;
  };
  CsvRows rows = rows_of(dialect, take);
  rows.feed(text);
  preview.open_quote_line = rows.open_quote_line();
  rows.finish();
  return preview;
}

std::ptrdiff_t number_rows(const Preview& preview) {
  return std::ranges::count_if(
      preview.rows, [&](const PreviewRow& row) { return is_number_row(row, preview.dialect); });
}

// `1,234;5,678` reads with either mark. Who separates by something else than the comma needs the
// comma.
char preferred_decimal(const Preview& preview) {
  if (preview.dialect.delimiter == ',') return '.';
  Dialect with_comma = preview.dialect;
  with_comma.decimal = ',';
  const auto has = [&](char mark) {
    return std::ranges::any_of(preview.rows, [&](const PreviewRow& row) {
      return is_number_row(row, with_comma) &&
             std::ranges::any_of(row.cells, [&](const auto& cell) {
               return cell.find(mark) != std::string_view::npos;
             });
    });
  };
  return has(',') && !has('.') ? ',' : '.';
}

// Most lines begin with a quote, as they do where each has been quoted as a whole.
bool may_be_requoted(std::string_view text) {
  std::ptrdiff_t lines = 0, quoted = 0;
  for (; !text.empty(); ++lines) {
    quoted += text.front() == '"' ? 1 : 0;
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
    text.remove_prefix(std::min(text.find_first_not_of("\r\n"), text.size()));
  }
  return 2 * quoted > lines;
}

// 1.5.26 or 01.05.2026, and no number of thousands.
bool is_dotted_date(std::string_view cell) {
  const std::size_t first = cell.find('.'), last = cell.rfind('.');
  return std::ranges::count(cell, '.') == 2 && first <= 2 && last - first <= 3 &&
         (cell.size() - last == 3 || cell.size() - last == 5);
}

// 10:00:01 or 2026-05-01: loggers write such a column beside their numbers.
bool is_clock_time(std::string_view cell) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  cell = without_half_day(cell);
  if (cell.ends_with('Z')) cell.remove_suffix(1);
  if (cell.find_first_not_of("0123456789:/-.,T ") != std::string_view::npos) return false;
  if (cell.empty() || !is_digit(cell.front()) || !is_digit(cell.back())) return false;
  const auto marks = std::ranges::count_if(cell, [](char c) { return c == '/' || c == '-'; });
  return cell.find(':') != std::string_view::npos || marks == 2 || is_dotted_date(cell);
}

struct Content {
  int numbers = 0, clocks = 0;
  std::vector<std::size_t> text;  // the columns that hold some
};

Content content_of(const PreviewRow& row, char decimal) {
  Content content;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string& cell = row.cells[i];
    if (cell.empty()) continue;
    if (is_clock_time(cell))
      ++content.clocks;
    else if (is_number(cell, decimal))
      ++content.numbers;
    else
      content.text.push_back(i);
  }
  return content;
}

// The columns that hold text in most of the rows with two numbers or more; empty where most of
// these have no text.
std::vector<std::size_t> text_columns_of(const Preview& preview) {
  std::map<std::vector<std::size_t>, int> rows;
  for (const PreviewRow& row : preview.rows)
    if (const Content content = content_of(row, preview.dialect.decimal); content.numbers >= 2)
      ++rows[content.text];
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto most = std::ranges::max_element(rows, fewer);
  return most == rows.end() ? std::vector<std::size_t>() : most->first;
}

// The preview with most rows of numbers so far; of two alike the first.
struct Best {
  Preview preview;
  std::ptrdiff_t rows = -1;

  void take(Preview other, bool with_text) {
    // Which cells are text depends on the decimal mark, so the columns of text are found for each.
    const auto set = [&](char decimal) {
      other.dialect.decimal = decimal;
      if (with_text) other.dialect.text_columns = text_columns_of(other);
    };
    set(',');
    const char preferred = preferred_decimal(other);
    for (const char decimal : {preferred, preferred == '.' ? ',' : '.'}) {
      set(decimal);
      const std::ptrdiff_t count = number_rows(other);
      if (count <= rows) continue;
      rows = count;
      preview = other;
    }
  }
};

}  // namespace

bool is_number_row(const PreviewRow& row, const Dialect& dialect) {
  const Content content = content_of(row, dialect.decimal);
  return std::ranges::includes(dialect.text_columns, content.text) &&
         (content.numbers >= 2 || (content.numbers == 1 && content.clocks > 0));
}

const std::string* text_among_numbers(const PreviewRow& row, char decimal) {
  const Content content = content_of(row, decimal);
  return content.numbers >= 2 && !content.text.empty() ? &row.cells[content.text[0]] : nullptr;
}

CsvRows rows_of(const Dialect& dialect, std::function<bool(const Row&)> take) {
  if (dialect.requoted) return {no_delimiter, requoted(dialect.delimiter, std::move(take))};
  return {dialect.delimiter, std::move(take)};
}

Preview make_preview(std::string_view text) {
  text = whole_lines(text);
  Best best;
  for (const char delimiter : delimiters) best.take(cut(text, {.delimiter = delimiter}), false);
  if (best.rows <= 1 && may_be_requoted(text))
    for (const char delimiter : delimiters)
      best.take(cut(text, {.delimiter = delimiter, .requoted = true}), false);
  if (best.rows <= 1)
    for (const char delimiter : delimiters) best.take(cut(text, {.delimiter = delimiter}), true);
  return std::move(best.preview);
}

}  // namespace havers::io
