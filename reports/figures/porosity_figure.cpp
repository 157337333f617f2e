// Figures of porosity: the histogram of a section, and methods to measure it compared.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {

Figure histogram_figure(const calib::DepthHistogram& histogram, const std::string& id) {
  Figure figure{.id = id,
                .description = "Pixels of the bone by depth, with the threshold",
                .width = 440,  // half a page
                .height = 240};
  if (histogram.depth.empty()) return figure;
  // Bone outnumbers pores: on a logarithmic scale both peaks show.
  figure.commands = data_block("depth", {histogram.depth, histogram.share}) +
                    fmt::format(
                        "set logscale y\nset yrange [1e-5:1]\nset format y '10^{{%L}}'\n"
                        "set xrange [{:.4g}:{:.4g}]\nunset key\n"
                        "set xlabel 'Depth: 0 bone, 1 pore' offset 0,0.5\n"
                        "set ylabel 'Share of the bone' offset 1.5,0\n"
                        "set style fill solid 0.35 noborder\n"
                        "set arrow from {:.4g},graph 0 to {:.4g},graph 1 nohead lw 2 lc rgb red\n"
                        "set label 'threshold' at {:.4g},graph 0.92 offset 0.6,0 tc rgb red\n"
                        "plot $depth using 1:2 with boxes lc rgb blue\n",
                        histogram.depth.front(), histogram.depth.back(), histogram.threshold,
                        histogram.threshold, histogram.threshold);
  return figure;
}

Figure methods_figure(const calib::MethodComparison& comparison, const std::string& id) {
  constexpr double smallest = 1e-3;  // [points]; less is drawn on the lower edge
  constexpr std::array<const char*, calib::porosity_methods> styles{
      "pt 4 ps 0.7 lc rgb grey", "pt 8 ps 0.8 lc rgb orange", "pt 6 ps 0.7 lc rgb red",
      "pt 7 ps 0.6 lc rgb blue"};
  Figure figure{.id = id,
                .description = "Error of porosity against CPU time of every section and method",
                .height = 380};
  std::string plots;
  for (std::size_t i = 0; i < styles.size(); ++i) {
    const auto method = static_cast<calib::PorosityMethod>(i);
    const std::string name = fmt::format("method{}", i);
    std::vector<double> time, error;
    for (const calib::PorosityTrial& trial : comparison.trials) {
      // A time too short to be measured is 0, which has no place on a logarithmic axis.
      // Milliseconds for a million pixels.
      time.push_back(std::max(1e-5, trial.readings.at(i).cpu) * 1e9 / trial.pixels);
      error.push_back(std::max(smallest, trial.error(method) / in::percent));
    }
    figure.commands += data_block(name, {time, error});
    plots += fmt::format("{}${} using 1:2 with points {} title '{}'",
                         plots.empty() ? "plot " : ", ", name, styles.at(i), to_string(method));
  }
  figure.commands +=
      "set logscale xy\nset format y '%g'\nset key outside top center horizontal\n"
      "set offsets graph 0.05,graph 0.05,graph 0.05,graph 0.05\n"
      "set xlabel 'CPU time of a million pixels (ms)' offset 0,0.5\n"
      "set ylabel 'Error (points of porosity)' offset 1.5,0\n" +
      plots + "\n";
  return figure;
}

}  // namespace havers::reports
