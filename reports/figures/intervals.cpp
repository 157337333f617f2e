// The intervals of several fits, a panel for each parameter; and the small bar of one interval in a
// table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

struct Estimate {
  std::size_t fit = 0;
  const calib::CalibratedParameter* parameter = nullptr;
};

// One panel a parameter, in the order in which the fits name them.
std::vector<std::vector<Estimate>> by_parameter(const std::vector<FitReport>& fits) {
  std::vector<std::vector<Estimate>> panels;
  std::map<std::string, std::size_t> place;
  for (std::size_t fit = 0; fit < fits.size(); ++fit)
    for (const auto& parameter : fits[fit].result.parameters) {
      if (!std::isfinite(parameter.value)) continue;
      const auto [at, fresh] = place.try_emplace(parameter.name, panels.size());
      if (fresh) panels.emplace_back();
      panels[at->second].push_back({fit, &parameter});
    }
  return panels;
}

std::string panel_commands(const std::vector<Estimate>& estimates, std::size_t number) {
  std::string data = fmt::format("$panel{} << EOD\n", number);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& [fit, parameter] : estimates) {
    const auto [low, high] = parameter->interval_95;
    // Without an interval only the point is drawn.
    const bool known = std::isfinite(low) && std::isfinite(high);
    const double from = known ? low : parameter->value, to = known ? high : parameter->value;
    data += fmt::format("{:.6g} {} {:.6g} {:.6g}\n", parameter->value, fit + 1, from, to);
    least = std::min(least, from);
    most = std::max(most, to);
  }
  const std::string tics =  // so few that "16.482" does not meet "16.484"
      most > least ? fmt::format("{}", round_down((most - least) / 3.0)) : "autofreq";
  return data +
         fmt::format(
             "EOD\nset xrange [{}*:*]\nset xtics {}\nset xlabel '{}' noenhanced offset 0,0.6\n"
             "plot $panel{} using 1:2:3:4 with xerrorbars pt 7 ps 0.9 lw 1.8 lc rgb blue\n",
             least < 0.0 ? "" : "0<", tics, plain(axis_label(estimates.front().parameter->name)),
             number);
}

// At most 24 characters of a name, none of them cut in two.
std::string shortened(const std::string& name) {
  const std::string start = fmt::format("{:.24}", name);
  return plain(start) + (start.size() < name.size() ? "…" : "");
}

// gnuplot takes the label of a tic for a format.
std::string as_format(const std::string& text) {
  static const std::regex percent("%");
  return std::regex_replace(text, percent, "%%");
}

std::string fit_names(const std::vector<FitReport>& fits) {
  std::string tics;
  for (std::size_t i = 0; i < fits.size(); ++i)
    tics += fmt::format("{}'{}' {}", i > 0 ? ", " : "", as_format(shortened(fits[i].study.name)),
                        i + 1);
  // The range is turned round, so that the first fit is on top.
  return fmt::format("set ytics noenhanced ({})\nset yrange [{}.5:0.5]\n", tics, fits.size());
}

}  // namespace

Figure intervals_figure(const std::vector<FitReport>& fits, const std::string& id) {
  const auto panels = by_parameter(fits);
  // Heights of an axis with its label and of a panel's rows; the figure has one of both for each
  // parameter. [px]
  const double axis = 62.0, rows = 26.0 * static_cast<double>(fits.size()) + 12.0;
  const double height = static_cast<double>(panels.size()) * (axis + rows);
  Figure figure{.id = id,
                .description = "95 % intervals of the parameters of every fit",
                .height = static_cast<int>(height)};
  if (panels.empty()) return figure;
  figure.commands =
      "set multiplot\nunset key\nset lmargin at screen 0.36\n"
      "set offsets graph 0.08, graph 0.08, 0, 0\n" +
      fit_names(fits);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double top = 1.0 - (static_cast<double>(i) * (axis + rows) + 4.0) / height;
    figure.commands += panel(top - rows / height, top) + panel_commands(panels[i], i);
  }
  figure.commands += "unset multiplot\n";
  return figure;
}

std::string interval_bar(const calib::CalibratedParameter& parameter) {
  constexpr double left = 4.0, width = 192.0;
  const double low = parameter.bounds[0], high = parameter.bounds[1];
  if (!std::isfinite(parameter.value) || !(high > low)) return {};
  // The ends of the bar are the bounds; an interval that reaches beyond is cut off there.
  const auto at = [&](double value) {
    return left + width * std::clamp((value - low) / (high - low), 0.0, 1.0);
  };
  std::string svg = fmt::format(
      R"(<svg class="bar" role="img" viewBox="0 0 200 16" width="200" height="16"><title>interval between )"
      R"(the bounds {} and {}</title><path d="M{:.1f} 8H{:.1f}M{:.1f} 4V12M{:.1f} 4V12" stroke="#999" )"
      R"(fill="none"/>)",
      setting(low), setting(high), left, left + width, left, left + width);
  const auto [from, to] = parameter.interval_95;
  if (std::isfinite(from) && std::isfinite(to))
    svg += fmt::format(R"(<rect x="{:.1f}" y="5" width="{:.1f}" height="6" fill="#56a0cf"/>)",
                       at(from), std::max(2.0, at(to) - at(from)));
  return svg + fmt::format(R"(<path d="M{:.1f} 2V14" stroke="#003a5d" stroke-width="2"/></svg>)",
                           at(parameter.value));
}

}  // namespace havers::reports
