// libcsv cuts any text, letter by letter. Lines of numbers have plain quotes or none: such a line,
// if it lies as a whole in the block, is cut here by the delimiter alone, in a fraction of the
// time. tests/io/machine/csv_rows_test.cpp checks on random texts that the rows are the same.
#include "io/machine/csv_rows.hpp"

#include <csv.h>

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "io/machine/units.hpp"

namespace havers::io {

struct CsvRows::State {
  csv_parser parser{};
  std::function<bool(const Row&)> take;
  std::string text;                     // the row's cells, end to end
  std::vector<std::size_t> ends;        // where each ends in `text`
  std::vector<std::string_view> cells;  // reused, so that no row allocates
  std::size_t line = 1;                 // where the row begins
  char line_end = '\0';  // '\n' as soon as one was seen; '\r' in files that have only these
  bool wanted = true;
};

namespace {

constexpr std::size_t longest_cell = 1U << 20U;   // [byte]; beyond it a quote was left open
constexpr int between_rows = 0, inside_cell = 2;  // libcsv's states, which csv.h does not name

void hand_on(CsvRows::State& state) {
  // A blank line is counted by the caller, but not handed on.
  const bool blank = state.cells.empty() || (state.cells.size() == 1 && state.cells[0].empty());
  if (state.wanted && !blank) state.wanted = state.take({state.line, state.cells});
}

void hand_on_parsed(CsvRows::State& state) {
  state.cells.clear();
  std::size_t begin = 0;
  for (const std::size_t end : state.ends) {
    state.cells.emplace_back(state.text.data() + begin, end - begin);
    begin = end;
  }
  hand_on(state);
  // Counts line ends inside quotes; the row's own end is counted by `on_row`.
  if (state.text.find(state.line_end) != std::string::npos)  // rarely: a quote spans lines
    state.line += static_cast<std::size_t>(std::ranges::count(state.text, state.line_end));
  state.text.clear();
  state.ends.clear();
}

void on_cell(void* cell, std::size_t length, void* data) {
  auto& state = *static_cast<CsvRows::State*>(data);
  state.text.append(static_cast<const char*>(cell), length);
  state.ends.push_back(state.text.size());
}

void on_row(int end, void* data) {
  auto& state = *static_cast<CsvRows::State*>(data);
  if (!state.ends.empty()) hand_on_parsed(state);
  // CR and LF of one line end are both reported, but only one of them counts a line.
  if (end == state.line_end) ++state.line;
}

void parse(CsvRows::State& state, std::string_view text) {
  const std::size_t used =
      csv_parse(&state.parser, text.data(), text.size(), on_cell, on_row, &state);
  if (used != text.size()) throw std::bad_alloc();  // libcsv fails on nothing else unless strict
}

// Cuts a line as libcsv does, in a fraction of the time, where its quotes are plain:
// `a,"1,004.5",c`. False where they are not.
bool cut_plain(CsvRows::State& state, std::string_view line) {
  while (line.ends_with('\r')) line.remove_suffix(1);
  // A line end of the other kind inside the line would be one for libcsv.
  const char other_end = state.line_end == '\n' ? '\r' : '\n';
  if (line.find(other_end) != std::string_view::npos) return false;
  const bool quotes = line.find('"') != std::string_view::npos;
  const char delimiter = static_cast<char>(state.parser.delim_char);
  state.cells.clear();
  while (true) {
    const bool quoted = quotes && line.starts_with('"');
    // Inside quotes a delimiter is text; an open quote takes the rest of the line.
    std::size_t end = quoted ? std::min(line.find('"', 1), line.size() - 1) + 1 : 0;
    while (end < line.size() && line[end] != delimiter) ++end;
    std::string_view cell = without_blanks(line.substr(0, end));
    // A quote that is not closed, is followed by text, or stands inside a cell is left to libcsv.
    if (quoted && (cell.size() < 2 || !cell.ends_with('"'))) return false;
    if (quoted) cell = cell.substr(1, cell.size() - 2);
    if (quotes && cell.find('"') != std::string_view::npos) return false;
    state.cells.push_back(cell);
    if (end == line.size()) return true;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

CsvRows::CsvRows(char delimiter, std::function<bool(const Row&)> take)
    : state_(std::make_unique<State>()) {
  state_->take = std::move(take);
  // With CSV_REPALL_NL blank lines are reported too, so that lines can be counted.
  if (csv_init(&state_->parser, CSV_REPALL_NL) != 0) throw std::bad_alloc();
  csv_set_delim(&state_->parser, static_cast<unsigned char>(delimiter));
}

CsvRows::~CsvRows() {
  csv_free(&state_->parser);
}

bool CsvRows::feed(std::string_view block) {
  State& state = *state_;
  // The first block decides which line end the file has.
  if (state.line_end == '\0')
    state.line_end = block.find('\n') == std::string_view::npos ? '\r' : '\n';
  while (!block.empty() && state.wanted && state.parser.entry_pos < longest_cell) {
    const std::size_t end = std::min(block.find(state.line_end), block.size());
    const std::size_t used = std::min(end + 1, block.size());
    // A line that begins inside a quote, or does not end in this block, is left to libcsv.
    const bool whole = end < used && state.parser.pstate == between_rows;
    if (whole && cut_plain(state, block.substr(0, end))) {
      hand_on(state);
      ++state.line;
    } else {
      parse(state, block.substr(0, used));
    }
    block.remove_prefix(used);
  }
  return state.wanted && state.parser.entry_pos < longest_cell;
}

void CsvRows::finish() {
  csv_fini(&state_->parser, on_cell, on_row, state_.get());
}

std::size_t CsvRows::open_quote_line() const {
  const State& state = *state_;
  if (state.parser.quoted == 0 || state.parser.pstate != inside_cell) return 0;
  // The row's earlier cells may span lines too.
  return state.line + static_cast<std::size_t>(std::ranges::count(state.text, state.line_end));
}

std::function<bool(const Row&)> requoted(char delimiter, std::function<bool(const Row&)> take) {
  return [delimiter, take = std::move(take)](const Row& line) {
    bool wanted = true;
    // The parser of each line counts from 1 again, so its rows are given the line of the file.
    CsvRows inner(delimiter, [&](const Row& row) {
      wanted = take({line.line, row.cells});
      return wanted;
    });
    inner.feed(line.cells[0]);
    inner.finish();
    return wanted;
  };
}

}  // namespace havers::io
