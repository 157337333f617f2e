// Error against cost on logarithmic axes, a line for each chain; the default chain with the band of
// its spread over the studies.
#include <fmt/format.h>

#include <array>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {

namespace {

constexpr int usual_height = 380;

// Two names have room side by side, above the axes. [pixels]
int legend_height(const calib::ChainBenchmark& benchmark) {
  const int entries = static_cast<int>(benchmark.summaries.size()) + 1;
  return 18 * ((entries + 1) / 2);
}

}  // namespace

Figure chains_figure(const calib::ChainBenchmark& benchmark, ChainCost cost,
                     const std::string& id) {
  constexpr std::array<const char*, 6> looks{
      "lc rgb grey",           "lc rgb orange dt (14,5)",     "lc rgb red dt (2,4)",
      "lc rgb green dt (8,4)", "lc rgb purple dt (14,4,2,4)", "lc rgb dark dt (5,3,2,3,2,3)"};
  const bool simulations = cost == ChainCost::simulations;
  Figure figure{.id = id,
                .description = "Error of the best point so far against what it cost, by chain",
                .height = usual_height + legend_height(benchmark)};
  std::string band, lines;
  for (std::size_t i = 0; i < benchmark.summaries.size(); ++i) {
    const calib::ChainSummary& summary = benchmark.summaries[i];
    const auto& steps = simulations ? summary.by_simulations : summary.by_seconds;
    std::vector<double> at, low, median, high;
    for (const calib::Progress& step : steps) {
      at.push_back(step.cost);
      low.push_back(step.error[0] / in::percent);  // Quantiles: 10, 50, 90 %.
      median.push_back(step.error[1] / in::percent);
      high.push_back(step.error[2] / in::percent);
    }
    if (at.empty()) continue;
    const std::string name = fmt::format("chain{}", i);
    figure.commands += data_block(name, {at, low, median, high});
    const bool usual = i == 0;  // the default chain is drawn last, with its band
    std::string& part = usual ? band : lines;
    part +=
        fmt::format(", ${} using 1:3 with lines lw {} {} title '{}'", name, usual ? 2.6 : 1.8,
                    usual ? "lc rgb blue" : looks.at((i - 1) % looks.size()), plain(summary.chain));
  }
  if (figure.commands.empty()) return figure;
  figure.commands += fmt::format(
      "set logscale xy\nset format y '%g'\nset format x '%g'\n"
      "set key samplen 4 font ',11' width -6\nset tmargin at screen {:.3f}\n"
      "set xlabel '{}' offset 0,0.5\nset ylabel 'Error of the parameters (%)' offset 1.5,0\n"
      "plot $chain0 using 1:2:4 with filledcurves lc rgb band title '10 to 90 % of the default'"
      "{}{}\n",
      1.0 - (legend_height(benchmark) + 12.0) / figure.height,
      simulations ? "Simulations" : "Wall time (s)", lines, band);
  return figure;
}

}  // namespace havers::reports
