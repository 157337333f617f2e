// How the cost rises from its minimum along each parameter, and the costs that the search started
// from and ended at.
#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

// Where the profile crosses the dashed line the 95 % interval ends.
std::string profile_panel(const calib::Profile& profile, std::size_t number) {
  return data_block(fmt::format("profile{}", number), {profile.value, profile.rise}) +
         fmt::format(
             "set xlabel '{}' noenhanced offset 0,0.6\nset ylabel 'Rise of the cost'\n"
             "plot {:.6g} with lines lw 1.2 dt 2 lc rgb grey notitle, $profile{} using 1:2 with "
             "linespoints pt 7 ps 0.8 lw 1.8 lc rgb blue notitle\n",
             plain(axis_label(profile.parameter)), profile.level, number);
}

}  // namespace

Figure profile_figure(const std::vector<calib::Profile>& profiles, const std::string& id) {
  // The figure has one of both for each parameter. [px]
  constexpr double panel_height = 170.0, axis = 62.0;
  const double height = static_cast<double>(profiles.size()) * (panel_height + axis);
  Figure figure{.id = id,
                .description = "Rise of the cost along each parameter, the others refitted",
                .height = static_cast<int>(height)};
  if (profiles.empty()) return figure;
  figure.commands = "set multiplot\nunset key\nset offsets graph 0.04, graph 0.04, graph 0.06, 0\n";
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const double top = 1.0 - (static_cast<double>(i) * (panel_height + axis) + 6.0) / height;
    figure.commands +=
        panel(top - (panel_height - 6.0) / height, top) + profile_panel(profiles[i], i);
  }
  figure.commands += "unset multiplot\n";
  return figure;
}

Figure waterfall_figure(const calib::CalibrationResult& result, const std::string& id) {
  Figure figure{.id = id,
                .description = "Costs of all starts and of those refined, lowest first",
                .width = 560,
                .height = 300};
  if (result.starts.empty()) return figure;
  std::vector<double> rank;
  for (std::size_t i = 0; i < std::max(result.starts.size(), result.ends.size()); ++i)
    rank.push_back(static_cast<double>(i + 1));
  figure.commands = data_block("starts", {rank, result.starts}) +
                    data_block("ends", {rank, result.ends}) + panel(0.2, 0.89) +
                    R"(
set xlabel 'Start, lowest cost first' offset 0,0.5
set ylabel 'Cost' offset 2,0
set logscale y
set format y '%g'
set autoscale yfix
set xtics 1
set offsets 0.4, 0.4, graph 0.06, graph 0.06
plot $starts using 1:2 with linespoints pt 6 ps 1 lw 1.4 lc rgb grey title 'starts', \
 $ends using 1:2 with points pt 7 ps 1.1 lc rgb blue title 'refined'
)";
  return figure;
}

}  // namespace havers::reports
