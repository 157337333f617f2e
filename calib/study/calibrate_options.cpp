#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "calib/fit/landmarks.hpp"
#include "calib/study/parameter.hpp"
#include "calib/study/study.hpp"

namespace havers::calib {
namespace {

using Complaints = std::vector<std::string>;

std::string names_to_choose_from() {
  std::string names;
  for (const auto& info : all_parameters())
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

void check_name(const std::string& name, const std::string& where, Complaints& found) {
  if (!find_parameter(name))
    found.push_back(
        fmt::format("{} names \"{}\", must be one of {}", where, name, names_to_choose_from()));
}

void check_parameters(const CalibrateOptions& options, Complaints& found) {
  if (options.parameters.empty() && !options.automatic)
    found.emplace_back("parameters is empty, must name at least one, or be \"auto\"");
  std::set<std::string> seen;
  for (const auto& name : options.parameters) {
    check_name(name, "parameters", found);
    if (!seen.insert(name).second)
      found.push_back(fmt::format("parameters names \"{}\" twice", name));
  }
}

// The one that a fit sets later undoes the other: resultant_MPa and aspect_ratio keep the ratio.
void check_rivals(const CalibrateOptions& options, Complaints& found) {
  const auto asked = [&](std::string_view name) {
    return std::ranges::find(options.parameters, name) != options.parameters.end();
  };
  for (const auto& [one, other] :
       {std::pair("ratio", "flank_MPa"), std::pair("head_tail_MPa", "resultant_MPa"),
        std::pair("resultant_MPa", "flank_MPa"), std::pair("aspect_ratio", "flank_MPa")})
    if (asked(one) && asked(other))
      found.push_back(fmt::format("parameters names {} and {}, which set the same stress; keep one",
                                  one, other));
}

void check_bounds(const CalibrateOptions& options, Complaints& found) {
  for (const auto& [name, bounds] : options.bounds) {
    const auto [lower, upper] = bounds;
    check_name(name, "bounds", found);
    const auto* info = find_parameter(name);
    if (!(lower < upper))
      found.push_back(fmt::format("bounds of {} are [{}, {}], must rise", name, lower, upper));
    if (info && info->scale == Scale::logarithmic && !(lower > 0.0))
      found.push_back(fmt::format("lower bound of {} is {}, must be > 0", name, lower));
    if (name == "scatter" && !(lower >= 0.0 && upper < 2.0))
      found.push_back(
          fmt::format("bounds of scatter are [{}, {}], must lie in [0, 2)", lower, upper));
  }
}

void check_terms(const CalibrateOptions& options, Complaints& found) {
  std::vector<std::string> known;
  for (Eigen::Index q = 0; q < landmark_count; ++q)
    known.emplace_back(name_of(static_cast<Landmark>(q)));
  if (options.terms.empty()) found.emplace_back("terms is empty, must name at least one");
  for (const auto& term : options.terms)
    if (std::ranges::find(known, term) == known.end())
      found.push_back(
          fmt::format("terms names \"{}\", must be one of {}", term, fmt::join(known, ", ")));
}

}  // namespace

Complaints CalibrateOptions::problems() const {
  Complaints found;
  check_parameters(*this, found);
  check_rivals(*this, found);
  check_bounds(*this, found);
  check_terms(*this, found);
  for (const auto& [name, value] : level) check_name(name, "level", found);
  if (replicates < 2 && replicates != replicates_by_need)
    found.push_back(
        fmt::format("replicates = {}, must be ≥ 2: their spread weighs the residuals", replicates));
  if (confirm < 0) found.push_back(fmt::format("confirm = {}, must be ≥ 0", confirm));
  if (budget < 1) found.push_back(fmt::format("budget = {}, must be ≥ 1", budget));
  if (threads < 0) found.push_back(fmt::format("threads = {}, must be ≥ 0", threads));
  return found;
}

}  // namespace havers::calib
