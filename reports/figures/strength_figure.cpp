// gnuplot does not keep labels apart. Names of specimens are therefore placed here, by an estimate
// of where points and letters are on the figure.
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

// Specimens that share a symbol: those of one orientation, in thousandths of a degree, and one use.
using Group = std::pair<long, calib::Use>;
using Groups = std::map<Group, std::vector<const calib::SpecimenResult*>>;

Groups groups_of(const std::vector<calib::SpecimenResult>& specimens) {
  Groups groups;
  for (const auto& specimen : specimens) {
    if (!std::isfinite(specimen.strength.mean) || !std::isfinite(specimen.measured.strength))
      continue;
    const long thousandths = std::lround(specimen.orientation * 180e3 / std::numbers::pi);
    groups[{thousandths, specimen.use}].push_back(&specimen);
  }
  return groups;
}

// An unknown error is drawn as a bar of no length.
double or_zero(double error) {
  return std::isfinite(error) ? error : 0.0;
}

// All strengths, on both axes. [MPa]
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
};

Range range_of(const Groups& groups) {
  Range range;
  for (const auto& [group, members] : groups)
    for (const auto* specimen : members)
      for (const double stress : {specimen->measured.strength, specimen->strength.mean}) {
        range.low = std::min(range.low, stress / in::MPa);
        range.high = std::max(range.high, stress / in::MPa);
      }
  return range;
}

// Orientations may differ so much that the weak would huddle in a corner.
bool is_wide(const Range& range) {
  return range.low > 0.0 && range.high > 3.0 * range.low;
}

enum class Side { right, left, none };

// A name or a point, its middle and width in pixels of the figure, nearly.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0;

  [[nodiscard]] bool meets(const Box& other) const {
    constexpr double height = 12.0;
    return std::abs(x - other.x) < 0.5 * (width + other.width) && std::abs(y - other.y) < height;
  }

  // How far the middle of another is from this name.
  [[nodiscard]] double distance(const Box& other) const {
    constexpr double half_height = 6.0;
    return std::hypot(std::max(0.0, std::abs(x - other.x) - 0.5 * width),
                      std::max(0.0, std::abs(y - other.y) - half_height));
  }
};

Box point_box(const calib::SpecimenResult& specimen, const Range& range) {
  // About as many pixels as the range of strengths has on the figure, and the size of a symbol.
  constexpr double along = 350.0, up = 280.0, symbol = 12.0;
  const auto part = [&](double stress) {
    const double value = stress / in::MPa;
    return is_wide(range) ? std::log(value / range.low) / std::log(range.high / range.low)
                          : (value - range.low) / (range.high - range.low);
  };
  return {along * part(specimen.measured.strength), up * part(specimen.strength.mean), symbol};
}

// Right below its point or left above it: points lie along the line of equality.
Box name_box(const calib::SpecimenResult& specimen, const Box& point, Side side) {
  constexpr double per_letter = 7.0, gap = 11.0;
  const double letters = per_letter * static_cast<double>(specimen.id.size());
  const double sign = side == Side::right ? 1.0 : -1.0;
  return {point.x + sign * (gap + 0.5 * letters), point.y - sign * 8.0, letters};
}

// Whether a reader would take the name for that of another point, or not read it at all.
bool misleads(const Box& name, std::size_t own, const std::vector<Box>& taken, std::size_t points) {
  constexpr double clearly = 1.25;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (name.meets(taken[i])) return true;
    if (i < points && i != own && name.distance(taken[i]) < clearly * name.distance(taken[own]))
      return true;
  }
  return false;
}

// A name stands on the side of the line where its point is, or on the other, or nowhere: it meets
// neither another name nor another's point, and is nearest to its own.
std::map<std::string, Side> sides_of(const Groups& groups, const Range& range) {
  std::vector<const calib::SpecimenResult*> all;
  for (const auto& [group, members] : groups) all.insert(all.end(), members.begin(), members.end());
  std::vector<Box> taken;
  taken.reserve(2 * all.size());
  for (const auto* specimen : all) taken.push_back(point_box(*specimen, range));
  std::map<std::string, Side> sides;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool below = all[i]->strength.mean < all[i]->measured.strength;
    Side& side = sides[all[i]->id] = Side::none;
    for (const Side tried : {below ? Side::right : Side::left, below ? Side::left : Side::right}) {
      const Box name = name_box(*all[i], taken[i], tried);
      if (misleads(name, i, taken, all.size())) continue;
      side = tried;
      taken.push_back(name);
      break;
    }
  }
  return sides;
}

std::string group_data(int number, const std::vector<const calib::SpecimenResult*>& members,
                       const std::map<std::string, Side>& sides) {
  std::string block = fmt::format("$group{} << EOD\n", number);
  for (const auto* specimen : members) {
    const auto name_on = [&](Side side) {
      return sides.at(specimen->id) == side ? plain(specimen->id) : "";
    };
    block +=
        fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} \"{}\" \"{}\"\n", specimen->measured.strength,
                    specimen->strength.mean, or_zero(specimen->measured.strength_standard_error),
                    or_zero(specimen->strength.sd), name_on(Side::right), name_on(Side::left));
  }
  return block + "EOD\n";
}

// An arrow from each test that was stopped before it broke to the strengths that it leaves open.
std::string stopped_data(const Groups& groups, const Range& range) {
  std::string rows;
  const double length = std::max(0.08 * (range.high - range.low), 0.01 * range.high);
  for (const auto& [group, members] : groups)
    for (const auto* specimen : members) {
      if (specimen->measured.broke) continue;
      const double strength = specimen->measured.strength / in::MPa;
      rows += fmt::format("{:.6g} {:.6g} {:.6g} 0\n", strength, specimen->strength.mean / in::MPa,
                          is_wide(range) ? 0.2 * strength : length);
    }
  return rows.empty() ? "" : "$stopped << EOD\n" + rows + "EOD\n";
}

// Equal axes; logarithmic ones where strengths differ much.
std::string axes(const Range& range) {
  if (is_wide(range))
    return fmt::format(
        "set logscale xy\nset xtics (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300)\n"
        "set ytics (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300)\n"
        "set xrange [{0:.4g}:{1:.4g}]\nset yrange [{0:.4g}:{1:.4g}]\n",
        0.8 * range.low, 1.35 * range.high);
  return "set offsets graph 0.08, graph 0.14, graph 0.08, graph 0.08\n";
}

// Filled symbols were fitted, open ones, white inside, only validated; the shape tells the
// orientation.
std::string group_plot(int number, const Group& group, int shape) {
  constexpr std::array<std::string_view, 5> colours{"blue", "red", "green", "purple", "orange"};
  const auto style = static_cast<std::size_t>(shape) % colours.size();
  const bool fitted = group.second == calib::Use::fit;
  const std::string inside =
      fitted ? ""
             : fmt::format(
                   ", $group{} using ($1*1e-6):($2*1e-6) with points pt {} ps 1.2 lc rgb "
                   "'white' notitle",
                   number, 5 + 2 * style);
  return fmt::format(
      "{5}, $group{0} using ($1*1e-6):($2*1e-6):($3*1e-6):($4*1e-6) with xyerrorbars pt {1} ps 1.2 "
      "lw 1.4 lc rgb {2} title '{3:.4g}°{4}', "
      "$group{0} using ($1*1e-6):($2*1e-6):5 with labels noenhanced left offset 1.3,-0.6 "
      "font ',11' tc rgb '#555555' notitle, "
      "$group{0} using ($1*1e-6):($2*1e-6):6 with labels noenhanced right offset -1.3,0.6 "
      "font ',11' tc rgb '#555555' notitle",
      number, 5 + 2 * style - (fitted ? 0 : 1), colours.at(style),
      1e-3 * static_cast<double>(group.first), fitted ? "" : ", validation", inside);
}

// Pixels for the rows of the legend that have no room above a figure of usual height.
int legend_room(const Groups& groups, bool stopped) {
  const bool long_names = stopped || std::ranges::any_of(groups, [](const auto& one) {
                            return one.first.second != calib::Use::fit;
                          });
  const int entries = 1 + static_cast<int>(groups.size()) + (stopped ? 1 : 0);
  const int in_a_row = long_names ? 2 : 4, rows = (entries + in_a_row - 1) / in_a_row;
  // A figure of usual height has room for two rows.
  return 20 * std::max(0, rows - 2);
}

}  // namespace

Figure strength_figure(const std::vector<calib::SpecimenResult>& specimens, const std::string& id) {
  Figure figure{.id = id,
                .description = "Simulated against measured strength of all specimens",
                .width = 560,
                .height = 480};
  const Groups groups = groups_of(specimens);
  if (groups.empty()) return figure;
  const Range range = range_of(groups);
  const auto sides = sides_of(groups, range);
  std::string data, plots;
  std::map<long, int> shapes;
  int number = 0;
  for (const calib::Use use : {calib::Use::fit, calib::Use::validate})  // open symbols on top
    for (const auto& [group, members] : groups) {
      const int shape =
          shapes.try_emplace(group.first, static_cast<int>(shapes.size())).first->second;
      if (group.second != use) continue;
      data += group_data(number, members, sides);
      plots += group_plot(number, group, shape);
      ++number;
    }
  const std::string stopped = stopped_data(groups, range);
  if (!stopped.empty()) {
    data += stopped;
    plots += ", $stopped with vectors filled lw 1.4 lc rgb dark title 'stopped, at least'";
  }
  const int room = legend_room(groups, !stopped.empty());
  const double bottom = 0.135 * figure.height, top = 0.12 * figure.height + room;
  figure.height += room;
  figure.commands = data + panel(bottom / figure.height, 1.0 - top / figure.height) + axes(range) +
                    R"(
set xlabel 'Measured strength (MPa)' offset 0,0.5
set ylabel 'Simulated strength (MPa)' offset 1,0
plot x with lines lw 1.2 dt 2 lc rgb grey title 'equal')" +
                    plots + "\n";
  return figure;
}

}  // namespace havers::reports
