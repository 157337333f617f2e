// gnuplot reads a figure's script from its standard input and writes an SVG to its standard output,
// which is then made fit to stand inside a page. If that fails, a sentence stands in its place.
#include "reports/figures/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mstch/mstch.hpp>

#include "reports/figures/process.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

// Look of every figure. Colours of Okabe and Ito, told apart by the colour-blind and, with line and
// point types, in grey.
constexpr std::string_view preamble = R"(
set encoding utf8
set minussign
set border 3 lc rgb '#444444' lw 1
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#e4e4e4' lw 0.6 lt 1
set key at graph 0, graph 1.03 left bottom horizontal Left reverse samplen 3 noenhanced
set style fill solid 1.0 noborder
set lmargin at screen 0.145
set rmargin at screen 0.965
band = '#b7d7ec'
blue = '#0072b2'
red = '#d55e00'
green = '#009e73'
orange = '#e69f00'
purple = '#aa4499'
dark = '#222222'
grey = '#888888'
)";

// Escaped for HTML and SVG as the templates of the pages do it.
std::string escaped(const std::string& text) {
  return mstch::render("{{text}}", mstch::map{{"text", text}});
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Several figures share one page, so every id and every reference to one begins with the figure's
// own.
void make_ids_unique(std::string& svg, const std::string& id) {
  for (const std::string_view before : {"id='", "id=\"", "href='#", "href=\"#", "url(#"})
    replace_all(svg, before, fmt::format("{}{}-", before, id));
}

// A plot without a title of ours has gnuplot's, its number or its command, which a browser would
// show where the mouse rests.
void drop_titles_of_gnuplot(std::string& svg) {
  constexpr std::string_view begin = "<title>", end = "</title>";
  for (const std::string_view own : {"<title>gnuplot_plot_", "<title>$"})
    for (std::size_t at = svg.find(own); at != std::string::npos; at = svg.find(own, at))
      svg.erase(at, svg.find(end, at + begin.size()) + end.size() - at);
}

// gnuplot's answer without its prologue, with a title for those who cannot see it; empty where it
// is no such answer.
std::string inline_svg(std::string svg, const Figure& figure) {
  svg.erase(0, std::min(svg.find("<svg"), svg.size()));
  drop_titles_of_gnuplot(svg);
  const std::size_t title = svg.find("<title>"), description = svg.find("</desc>", title);
  if (description == std::string::npos || svg.find("</svg>") == std::string::npos) return {};
  svg.replace(title, description + 7 - title, "<title>" + escaped(figure.description) + "</title>");
  svg.insert(4, R"( role="img" width="100%")");
  make_ids_unique(svg, figure.id);
  return svg;
}

// What gnuplot said on its last line, which names the reason.
std::string last_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::string sentence_svg(std::string_view sentence) {
  return fmt::format(
      R"(<svg role="img" width="100%" viewBox="0 0 640 40" xmlns="http://www.w3.org/2000/svg">
<text x="8" y="25" font-family="sans-serif" font-size="13" fill="#a03000">{}</text></svg>
)",
      escaped(std::string(sentence)));
}

std::string draw(const Figure& figure) {
  if (figure.commands.empty()) return sentence_svg("Nothing to draw: there are no finite numbers.");
  const ProcessResult gnuplot =
      run_process({"gnuplot", "--default-settings"},
                  fmt::format("set terminal svg size {},{} dynamic font 'sans-serif,13'\n{}{}",
                              figure.width, figure.height, preamble, figure.commands));
  if (!gnuplot.started)
    return sentence_svg(
        "Figure not drawn: gnuplot did not start (apt-get install gnuplot-nox), or TMPDIR names no "
        "folder that can be written.");
  std::string svg = gnuplot.status == 0 ? inline_svg(gnuplot.output, figure) : "";
  if (!svg.empty()) return svg;
  const std::string said = last_line(gnuplot.errors);
  return sentence_svg(said.empty() ? "Figure not drawn: gnuplot was ended, or gave no figure."
                                   : "Figure not drawn; gnuplot says: " + said);
}

std::string data_block(std::string_view name,
                       std::initializer_list<std::span<const double>> columns) {
  std::size_t rows = std::numeric_limits<std::size_t>::max();
  for (const auto& column : columns) rows = std::min(rows, column.size());
  std::string block = fmt::format("${} << EOD\n", name);
  for (std::size_t row = 0; row < rows; ++row) {
    for (const auto& column : columns)
      block += std::isfinite(column[row]) ? fmt::format("{:.6g} ", column[row]) : "NaN ";
    block += '\n';
  }
  return block + "EOD\n";
}

std::string panel(double bottom, double top) {
  return fmt::format("set bmargin at screen {:.3f}\nset tmargin at screen {:.3f}\n", bottom, top);
}

std::string x_range(std::initializer_list<std::span<const double>> values, double scale) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& column : values)
    for (const double value : column)
      if (std::isfinite(value)) {
        low = std::min(low, value * scale);
        high = std::max(high, value * scale);
      }
  if (low > high) return {};
  // A range must have a length, also around a single value.
  const double margin = high > low ? 0.02 * (high - low) : 1.0;
  return fmt::format("set xrange [{:.6g}:{:.6g}]\n", low - margin, high + margin);
}

std::string few_tics(std::span<const double> values, double scale) {
  double low = 0.0, high = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value * scale);
    high = std::max(high, value * scale);
  }
  return high > low ? fmt::format("set ytics {}\n", round_down((high - low) / 2.0)) : "";
}

}  // namespace havers::reports
