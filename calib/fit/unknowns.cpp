// From what a study asks for to the unknowns of its search, and from a point to each specimen's
// values.
#include "calib/fit/unknowns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/fit/scenes.hpp"

namespace havers::calib {
namespace {

bool scatter_is_measured(const Study& study) {
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    if (model_of(study, s).scatter_told) return true;
  return false;
}

// "auto" tries what nothing else tells.
bool searched(const Study& study, const ParameterInfo& info) {
  const CalibrateOptions& options = study.calibrate;
  if (options.automatic)
    return info.automatic && !(info.name == "scatter" && scatter_is_measured(study));
  return std::ranges::find(options.parameters, info.name) != options.parameters.end();
}

Level level_of(const CalibrateOptions& options, const ParameterInfo& info) {
  const auto found = options.level.find(std::string(info.name));
  return found == options.level.end() ? Level::shared : found->second;
}

// The end of a label. Specimens whose text agrees, angles to four digits, share a value.
std::string group_of(const Specimen& specimen, Level level) {
  if (level == Level::shared) return "";
  if (level == Level::specimen) return fmt::format("[{}]", specimen.id);
  return fmt::format("[{:.4g} deg]", specimen.orientation / degree);
}

// With the study's bounds, or the parameter's usual ones, and the study's value as its start.
Unknown bounded(const Study& study, const ParameterInfo& info) {
  const auto given = study.calibrate.bounds.find(std::string(info.name));
  const auto bounds =
      given == study.calibrate.bounds.end() ? std::pair(info.lower, info.upper) : given->second;
  Unknown unknown{.info = &info, .label = std::string(info.name), .bounds = bounds};
  unknown.lower = to_search(info, bounds.first);
  unknown.upper = to_search(info, bounds.second);
  const double value =
      info.of_porosity ? value_of(study.porosity, info.name) : value_of(study.model, info.name);
  unknown.start = std::clamp(to_search(info, value), unknown.lower, unknown.upper);
  return unknown;
}

// Groups are those of the fitted specimens, in the order of the study; those held out join them.
void add_groups(const Study& study, const ParameterInfo& info, std::vector<Unknown>& unknowns) {
  const Level level = level_of(study.calibrate, info);
  const auto group = [&](const Specimen& specimen) {
    return std::ranges::find(unknowns, std::string(info.name) + group_of(specimen, level),
                             &Unknown::label);
  };
  for (const auto& specimen : study.specimens)
    if (specimen.use == Use::fit && group(specimen) == unknowns.end()) {
      unknowns.push_back(bounded(study, info));
      unknowns.back().label += group_of(specimen, level);
      unknowns.back().level = level;
    }
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    if (const auto found = group(study.specimens[s]); found != unknowns.end())
      found->specimens.push_back(s);
}

}  // namespace

double to_search(const ParameterInfo& info, double value) {
  return info.scale == Scale::logarithmic ? std::log(value) : value;
}

double from_search(const ParameterInfo& info, double position) {
  return info.scale == Scale::logarithmic ? std::exp(position) : position;
}

std::vector<Unknown> unknowns_of(const Study& study) {
  std::vector<Unknown> unknowns;
  for (const auto& info : all_parameters())
    if (searched(study, info)) add_groups(study, info, unknowns);
  return unknowns;
}

Point start_point(const std::vector<Unknown>& unknowns) {
  Point point(static_cast<Eigen::Index>(unknowns.size()));
  std::ranges::transform(unknowns, point.begin(), &Unknown::start);
  return point;
}

Point middle_point(const std::vector<Unknown>& unknowns) {
  Point point(static_cast<Eigen::Index>(unknowns.size()));
  std::ranges::transform(unknowns, point.begin(),
                         [](const Unknown& u) { return 0.5 * (u.lower + u.upper); });
  return point;
}

Point inside_bounds(const std::vector<Unknown>& unknowns, Point point) {
  std::ranges::transform(point, unknowns, point.begin(), [](double z, const Unknown& u) {
    // An optimiser may ask for a point with NaN.
    return std::isfinite(z) ? std::clamp(z, u.lower, u.upper) : u.start;
  });
  return point;
}

double value_in_unit(const Unknown& unknown, double position) {
  const auto& [lower, upper] = unknown.bounds;
  if (position == unknown.lower) return lower;
  if (position == unknown.upper) return upper;
  return std::clamp(from_search(*unknown.info, position), lower, upper);
}

std::optional<double> value_at(const std::vector<Unknown>& unknowns, const Point& point,
                               const ParameterInfo& info, std::size_t specimen) {
  double sum = 0.0;
  int groups = 0;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    if (unknowns[k].info != &info) continue;
    const double position = point[static_cast<Eigen::Index>(k)];
    if (std::ranges::find(unknowns[k].specimens, specimen) != unknowns[k].specimens.end())
      return value_in_unit(unknowns[k], position);
    sum += position;
    ++groups;
  }
  if (groups == 0) return std::nullopt;
  // For other specimens the mean over the groups, in the scale of the search: of logarithms a
  // geometric one.
  return from_search(info, sum / groups);
}

}  // namespace havers::calib
