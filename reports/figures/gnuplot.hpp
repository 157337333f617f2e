// Figures drawn by gnuplot, which runs as a program of its own.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace havers::reports {

/// What to draw. The commands find the common look of all figures set, and colours by name: band,
/// blue, red, green, orange, purple, dark, grey.
struct Figure {
  std::string id;           ///< Unique on its page; begins every id inside the SVG.
  std::string description;  ///< One sentence, for those who cannot see the figure.
  int width = 640;          ///< In the figure's own pixels; text is 13 of them high.
  int height = 400;
  std::string commands = {};  ///< gnuplot; empty when there is nothing to draw.
};

/// The figure as an SVG that fills the width of whatever holds it. Never fails: without data,
/// without gnuplot or when gnuplot complains, the SVG is a sentence that says so.
std::string draw(const Figure& figure);

/// An SVG that is one sentence, for a figure that cannot be drawn.
std::string sentence_svg(std::string_view sentence);

/// `$name << EOD ... EOD`: the columns side by side, as long as the shortest.
std::string data_block(std::string_view name,
                       std::initializer_list<std::span<const double>> columns);

/// Margins of one of several panels above each other; 0 is the figure's lower edge, 1 the upper.
std::string panel(double bottom, double top);

/// `set xrange [low:high]`, a little wider than the finite values times `scale`; empty without any.
std::string x_range(std::initializer_list<std::span<const double>> values, double scale);

/// Few enough tics for a low panel that shows `values` times `scale`.
std::string few_tics(std::span<const double> values, double scale);

}  // namespace havers::reports
