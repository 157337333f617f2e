#include "io/machine/preview.hpp"

#include <algorithm>
#include <utility>

#include "io/machine/number.hpp"

namespace havers::io {
namespace {

constexpr std::size_t preview_bytes = 1U << 16U;

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

std::ptrdiff_t number_rows(const Preview& preview, char decimal) {
  return std::ranges::count_if(preview.rows,
                               [&](const PreviewRow& row) { return is_number_row(row, decimal); });
}

// `1,234;5,678` reads with either mark. Who separates by something else than the comma needs the
// comma.
char preferred_decimal(const Preview& preview) {
  if (preview.dialect.delimiter == ',') return '.';
  const auto has = [&](char mark) {
    return std::ranges::any_of(preview.rows, [&](const PreviewRow& row) {
      return is_number_row(row, ',') && std::ranges::any_of(row.cells, [&](const auto& cell) {
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
  if (cell.ends_with('Z')) cell.remove_suffix(1);
  if (cell.find_first_not_of("0123456789:/-.,T ") != std::string_view::npos) return false;
  if (cell.empty() || !is_digit(cell.front()) || !is_digit(cell.back())) return false;
  const auto marks = std::ranges::count_if(cell, [](char c) { return c == '/' || c == '-'; });
  return cell.find(':') != std::string_view::npos || marks == 2 || is_dotted_date(cell);
}

}  // namespace

bool is_number_row(const PreviewRow& row, char decimal) {
  int numbers = 0, clocks = 0;
  for (const std::string& cell : row.cells) {
    if (cell.empty()) continue;
    if (is_clock_time(cell))
      ++clocks;
    else if (is_number(cell, decimal))
      ++numbers;
    else
      return false;
  }
  return numbers >= 2 || (numbers == 1 && clocks > 0);
}

const std::string* text_among_numbers(const PreviewRow& row, char decimal) {
  const std::string* text = nullptr;
  int numbers = 0;
  for (const std::string& cell : row.cells) {
    if (cell.empty() || is_clock_time(cell)) continue;
    if (is_number(cell, decimal))
      ++numbers;
    else if (text == nullptr)
      text = &cell;
  }
  return numbers >= 2 ? text : nullptr;
}

CsvRows rows_of(const Dialect& dialect, std::function<bool(const Row&)> take) {
  if (dialect.requoted) return {no_delimiter, requoted(dialect.delimiter, std::move(take))};
  return {dialect.delimiter, std::move(take)};
}

Preview make_preview(std::string_view text) {
  text = whole_lines(text);
  Preview best;
  std::ptrdiff_t most = -1;
  for (const bool quoted_again : {false, true}) {
    if (quoted_again && (most > 1 || !may_be_requoted(text))) break;
    for (const char delimiter : {',', ';', '\t', '|'}) {
      Preview preview = cut(text, {.delimiter = delimiter, .requoted = quoted_again});
      const char preferred = preferred_decimal(preview);
      for (const char decimal : {preferred, preferred == '.' ? ',' : '.'}) {
        const std::ptrdiff_t count = number_rows(preview, decimal);
        if (count <= most) continue;
        most = count;
        preview.dialect.decimal = decimal;
        best = preview;
      }
    }
  }
  return best;
}

}  // namespace havers::io
