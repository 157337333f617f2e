// Two benches of fits on studies of known truth: which chain of optimisers is the cheapest, and
// whether 95 % intervals hold the truth as often as they say.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

#include "reports/bench_pages.hpp"
#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

// "12 (8 to 31)": median, and 10 to 90 %; of one study its value.
std::string spread(const std::array<double, 3>& quantiles, double unit, int digits) {
  if (quantiles[0] == quantiles[2]) return number(quantiles[1] / unit, digits);
  return fmt::format("{} ({} to {})", number(quantiles[1] / unit, digits),
                     number(quantiles[0] / unit, digits), number(quantiles[2] / unit, digits));
}

std::string rate_text(const calib::Rate& rate) {
  if (!std::isfinite(rate.part)) return "–";
  return fmt::format("{:.1f} ({:.1f} to {:.1f})", rate.part / in::percent,
                     rate.interval_95[0] / in::percent, rate.interval_95[1] / in::percent);
}

mstch::map chain_row(const calib::ChainSummary& chain, bool usual) {
  // Rounded: a part of a simulation means nothing.
  const auto& [low, median, high] = chain.simulations;
  const std::string range = low == high ? "" : fmt::format(" ({:.0f} to {:.0f})", low, high);
  return {{"chain", text(chain.chain + (usual ? " (default)" : ""))},
          {"error", text(spread(chain.error, in::percent, 2))},
          {"simulations", text(fmt::format("{:.0f}{}", median, range))},
          {"seconds", text(spread(chain.seconds, 1.0, 2))},
          {"success", text(rate_text(chain.success))}};
}

// Contenders whose 10 to 90 % of simulations meet the winner's: another study may turn the two.
std::vector<std::string> near_the_winner(const calib::ChainBenchmark& benchmark) {
  const calib::ChainSummary& winner = benchmark.winner();
  std::vector<std::string> names;
  for (const calib::ChainSummary* one : benchmark.contenders())
    if (one != &winner && one->simulations[0] <= winner.simulations[2])
      names.push_back(fmt::format("“{}”", one->chain));
  return names;
}

mstch::map coverage_row(const calib::CoverageSummary& one, calib::IntervalWidth judged) {
  return {{"design", text(typeset(one.design))},
          {"parameter", text(symbol_of(one.parameter))},
          {"informed", text(fmt::format("{} of {}", one.informed, one.studies))},
          {"inside", text(rate_text(one.inside))},
          {"judged", text(one.informed > 0 ? to_string(judged) : "–")},
          {"width", text(one.informed > 0 ? spread(one.half_width, in::percent, 2) : "–")}};
}

// By the shares that are not too few to tell.
std::string what_shares_say(const std::set<calib::IntervalWidth>& widths) {
  using enum calib::IntervalWidth;
  if (widths.contains(too_narrow)) return "Some intervals are too narrow by more than chance.";
  if (widths.contains(too_wide))
    return "Some intervals are too wide by more than chance, none too narrow.";
  return widths.empty() ? "Too few studies to tell the shares from 95\u00a0%."
                        : "No share differs from 95\u00a0% by more than chance.";
}

}  // namespace

std::string chains_page(const calib::ChainBenchmark& benchmark,
                        const calib::Provenance& provenance) {
  const auto& summaries = benchmark.summaries;
  const calib::ChainSummary& winner = benchmark.winner();
  const bool usual = winner.chain == summaries.front().chain;
  const auto fits = static_cast<long>(benchmark.rows.size());
  const std::size_t studies = benchmark.rows.size() / summaries.size();
  const std::vector<std::string> near = near_the_winner(benchmark);
  const auto row = [&](const calib::ChainSummary& chain) {
    return chain_row(chain, &chain == &summaries.front());
  };
  return render_page(
      "havers bench: chains of optimisers", "chains",
      {{"grade", grade(usual || !near.empty(), usual)},
       {"sentence",
        text(fmt::format("The chain “{}” needs the fewest simulations{} of those that succeed most "
                         "often with the least error.",
                         winner.chain, near.empty() ? "" : ", though not clearly,"))},
       {"detail", text(fmt::format("{} of {} of known truth. {}{}", count(fits, "fit"),
                                   studies == 1 ? "1 study" : fmt::format("{} studies", studies),
                                   usual ? "It is the default." : "It is not the default.",
                                   near.empty() ? ""
                                                : fmt::format(" Its range meets that of {}.",
                                                              fmt::join(near, ", "))))},
       {"chains", list_of(summaries, row)},
       {"by_simulations",
        text(draw(chains_figure(benchmark, ChainCost::simulations, "bysimulations")))},
       {"by_seconds", text(draw(chains_figure(benchmark, ChainCost::seconds, "byseconds")))}},
      provenance);
}

std::string coverage_page(const calib::Coverage& coverage, const calib::Provenance& provenance) {
  mstch::array rows;
  int inside = 0, informed = 0;
  std::set<calib::IntervalWidth> widths;
  for (const calib::CoverageSummary& one : coverage.summaries) {
    widths.insert(coverage.width_of(one));
    rows.emplace_back(coverage_row(one, coverage.width_of(one)));
    informed += one.informed;
    inside += one.held();
  }
  const calib::Rate all = calib::rate_of(inside, informed);
  widths.erase(calib::IntervalWidth::too_few);
  const std::string stopped = coverage.complete ? "" : "Stopped before all studies were fitted. ";
  return render_page(
      "havers bench: what the intervals hold", "coverage",
      {{"grade", grade(coverage.holds(), coverage.complete && !widths.empty())},
       {"sentence", text(fmt::format("{}Of {} {}\u00a0% hold the truth; 95\u00a0% should.", stopped,
                                     count(informed, "interval"), rate_text(all)))},
       {"detail", text(what_shares_say(widths))},
       {"rows", rows}},
      provenance);
}

}  // namespace havers::reports
