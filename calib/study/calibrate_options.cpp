// All that is wrong with [calibrate] is told at once, so that a study can be mended in one go.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "calib/fit/landmarks.hpp"
#include "calib/study/parameter.hpp"
#include "calib/study/study.hpp"

namespace havers::calib {
namespace {

using Complaints = std::vector<CalibrateOptions::Problem>;

std::string names_to_choose_from() {
  std::string names;
  for (const auto& info : all_parameters())
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

// `table` is the key of [calibrate] that names the parameter.
void check_name(const std::string& name, const std::string& table, Complaints& found) {
  if (!find_parameter(name))
    found.push_back(
        {table, fmt::format("names \"{}\", must be one of {}", name, names_to_choose_from())});
}

void check_parameters(const CalibrateOptions& options, Complaints& found) {
  if (options.parameters.empty() && !options.automatic)
    found.push_back({"parameters", "is empty, must name at least one, or be \"auto\""});
  std::set<std::string> seen;
  for (const auto& name : options.parameters) {
    check_name(name, "parameters", found);
    if (!seen.insert(name).second)
      found.push_back({"parameters", fmt::format("names \"{}\" twice", name)});
  }
}

// The one that a fit sets later undoes the other: ratio and flank_MPa both set σ₂, head_tail_MPa
// and resultant_MPa scale all stresses, flank_MPa changes the resultant, and aspect_ratio, which
// keeps the ratio, changes σ₂.
void check_rivals(const CalibrateOptions& options, Complaints& found) {
  const auto asked = [&](std::string_view name) {
    return std::ranges::find(options.parameters, name) != options.parameters.end();
  };
  for (const auto& [one, other] :
       {std::pair("ratio", "flank_MPa"), std::pair("head_tail_MPa", "resultant_MPa"),
        std::pair("resultant_MPa", "flank_MPa"), std::pair("aspect_ratio", "flank_MPa")})
    if (asked(one) && asked(other))
      found.push_back(
          {"parameters",
           fmt::format("names {} and {}, of which one undoes the other; keep one", one, other)});
}

void check_bounds(const CalibrateOptions& options, Complaints& found) {
  for (const auto& [name, bounds] : options.bounds) {
    const auto [lower, upper] = bounds;
    check_name(name, "bounds", found);
    const auto* info = find_parameter(name);
    const std::string key = "bounds." + name;
    // Written so that a bound that is NaN is wrong too.
    if (!(lower < upper))
      found.push_back({key, fmt::format("is [{}, {}], must rise", lower, upper)});
    if (info && info->scale == Scale::logarithmic && !(lower > 0.0))
      found.push_back({key, fmt::format("starts at {}, must start above 0", lower)});
    // At d = 2 a joint would start broken (M8).
    if (name == "scatter" && !(lower >= 0.0 && upper < 2.0))
      found.push_back({key, fmt::format("is [{}, {}], must lie in [0, 2)", lower, upper)});
  }
}

// The terms are the landmarks of a curve (F4), by their names.
void check_terms(const CalibrateOptions& options, Complaints& found) {
  std::vector<std::string> known;
  for (Eigen::Index q = 0; q < landmark_count; ++q)
    known.emplace_back(name_of(static_cast<Landmark>(q)));
  if (options.terms.empty()) found.push_back({"options.terms", "is empty, must name at least one"});
  for (const auto& term : options.terms)
    if (std::ranges::find(known, term) == known.end())
      found.push_back({"options.terms", fmt::format("names \"{}\", must be one of {}", term,
                                                    fmt::join(known, ", "))});
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
    found.push_back({"options.replicates",
                     fmt::format("is {}, must be 0 (as many as needed), or 2 or more: their spread "
                                 "weighs the residuals",
                                 replicates)});
  if (confirm < 0)
    found.push_back({"options.confirm", fmt::format("is {}, must be 0 or more", confirm)});
  if (budget < 1)
    found.push_back({"options.budget", fmt::format("is {}, must be 1 or more", budget)});
  if (threads < 0) found.push_back({"threads", fmt::format("is {}, must be 0 or more", threads)});
  return found;
}

}  // namespace havers::calib
