#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "reports/figures/figures.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

// Specimens that share a symbol: those of one orientation and one use.
using Group = std::pair<long, calib::Use>;
using Groups = std::map<Group, std::vector<const calib::SpecimenResult*>>;

Groups groups_of(const std::vector<calib::SpecimenResult>& specimens) {
  Groups groups;
  for (const auto& specimen : specimens) {
    if (!std::isfinite(specimen.strength.mean) || !std::isfinite(specimen.measured.strength))
      continue;
    const long degrees = std::lround(specimen.orientation * 180.0 / std::numbers::pi);
    groups[{degrees, specimen.use}].push_back(&specimen);
  }
  return groups;
}

double or_zero(double error) {
  return std::isfinite(error) ? error : 0.0;
}

// Whether another specimen lies so near that the two names would be printed on top of each other.
bool crowded(const calib::SpecimenResult& one, const Groups& groups) {
  constexpr double near = 0.08;  // of the strength
  for (const auto& [group, members] : groups)
    for (const auto* other : members)
      if (other != &one &&
          std::abs(other->measured.strength / one.measured.strength - 1.0) < near &&
          std::abs(other->strength.mean / one.strength.mean - 1.0) < near)
        return true;
  return false;
}

std::string group_data(int number, const Group& group, const Groups& groups) {
  std::string block = fmt::format("$group{} << EOD\n", number);
  for (const auto* specimen : groups.at(group))
    block += fmt::format(
        "{:.6g} {:.6g} {:.6g} {:.6g} \"{}\"\n", specimen->measured.strength,
        specimen->strength.mean, or_zero(specimen->measured.strength_standard_error),
        or_zero(specimen->strength.sd), crowded(*specimen, groups) ? "" : plain(specimen->id));
  return block + "EOD\n";
}

// Equal axes; logarithmic ones where orientations differ so much that the weak would huddle in a
// corner.
std::string axes(const Groups& groups) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const auto& [group, members] : groups)
    for (const auto* specimen : members) {
      low =
          std::min({low, specimen->measured.strength / in::MPa, specimen->strength.mean / in::MPa});
      high = std::max(
          {high, specimen->measured.strength / in::MPa, specimen->strength.mean / in::MPa});
    }
  if (low > 0.0 && high > 3.0 * low)
    return fmt::format(
        "set logscale xy\nset xtics (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300)\n"
        "set ytics (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300)\n"
        "set xrange [{0:.4g}:{1:.4g}]\nset yrange [{0:.4g}:{1:.4g}]\n",
        0.8 * low, 1.35 * high);
  return "set offsets graph 0.08, graph 0.14, graph 0.08, graph 0.08\n";
}

// Filled symbols were fitted, open ones only validated; the shape tells the orientation.
std::string group_plot(int number, const Group& group, int shape) {
  constexpr std::array<std::string_view, 5> colours{"blue", "red", "green", "purple", "orange"};
  const auto style = static_cast<std::size_t>(shape) % colours.size();
  const bool fitted = group.second == calib::Use::fit;
  return fmt::format(
      ", $group{0} using ($1*1e-6):($2*1e-6):($3*1e-6):($4*1e-6) with xyerrorbars pt {1} ps 1.2 lw "
      "1.4 "
      "lc rgb {2} title '{3}°{4}', "
      "$group{0} using ($1*1e-6):($2*1e-6):5 with labels noenhanced left offset 0.9,-0.7 "
      "font ',11' tc rgb '#555555' notitle",
      number, 5 + 2 * style - (fitted ? 0 : 1), colours.at(style), group.first,
      fitted ? "" : ", validation");
}

}  // namespace

Figure strength_figure(const std::vector<calib::SpecimenResult>& specimens, const std::string& id) {
  Figure figure{.id = id,
                .description = "Simulated against measured strength of all specimens",
                .width = 560,
                .height = 440};
  const Groups groups = groups_of(specimens);
  if (groups.empty()) return figure;
  std::string data, plots;
  std::map<long, int> shapes;
  int number = 0;
  for (const auto& [group, members] : groups) {
    const int shape =
        shapes.try_emplace(group.first, static_cast<int>(shapes.size())).first->second;
    data += group_data(number, group, groups);
    plots += group_plot(number, group, shape);
    ++number;
  }
  figure.commands = data + panel(0.145, 0.97) + axes(groups) + R"(
set xlabel 'Measured strength (MPa)' offset 0,0.5
set ylabel 'Simulated strength (MPa)' offset 1,0
set key inside at graph 0.02, graph 0.98 left top vertical
plot x with lines lw 1.2 dt 2 lc rgb grey title 'equal')" +
                    plots + "\n";
  return figure;
}

}  // namespace havers::reports
