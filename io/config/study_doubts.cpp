// Each `doubt_` function looks at one part of a study. It asks the file whether a key is there:
// that a key changes nothing is to be said only where the user wrote it.
#include "io/config/study_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "calib/study/parameter.hpp"

namespace havers::io {
namespace {

using Sentences = std::vector<std::string>;

bool is_fitted(const calib::CalibrateOptions& options, const calib::ParameterInfo& info) {
  return options.automatic
             ? info.automatic
             : std::ranges::find(options.parameters, info.name) != options.parameters.end();
}

void changes_nothing(Sentences& found, std::string_view key, std::string_view why) {
  found.push_back(fmt::format("{} changes nothing: {}", key, why));
}

// Keys that come with a scene pasted as a whole, but that a study takes from elsewhere.
void doubt_model(TableReader model, const StudyFile& read, Sentences& found) {
  if (read.study.model.assembly.orientation != 0.0)
    changes_nothing(found, "model.assembly.orientation_deg", "every specimen has its own");
  TableReader joints = model.table("joints");
  if (joints.has("seed"))
    changes_nothing(found, "model.joints.seed", "calibrate.options.seed draws the thresholds");
  const calib::PorosityOptions& laws = read.study.porosity;
  const bool all_tell = std::ranges::all_of(read.specimens, [&](const SpecimenFiles& specimen) {
    return calib::tells_scatter(specimen, laws);
  });
  if (joints.has("scatter") && all_tell && laws.to_scatter == calib::ToScatter::linear)
    changes_nothing(found, "model.joints.scatter", "every specimen has one from its porosity");
  // Asked for here so that the key is a known one: a study has no other use for [model.output].
  int snapshots = 0;
  if (model.table("output").key("snapshots", snapshots) && snapshots != 0)
    changes_nothing(found, "model.output.snapshots", "a fit writes none");
}

// What only one law of porosity has, and which.
struct LawKey {
  const char *key, *law;
  bool in_use;
};

void doubt_porosity(TableReader top, const StudyFile& read, Sentences& found) {
  const bool sections = std::ranges::any_of(
      read.specimens, [](const SpecimenFiles& specimen) { return !specimen.sections.empty(); });
  // A porosity of its own, or sections that will give one.
  const bool porous =
      sections || std::ranges::any_of(read.specimens, [](const SpecimenFiles& specimen) {
        return specimen.porosity.has_value();
      });
  if (top.has("sections") && !sections) changes_nothing(found, "sections", "no specimen has any");
  const calib::PorosityOptions& laws = read.study.porosity;
  const bool window = laws.to_scatter == calib::ToScatter::window;
  const bool linear = laws.to_scatter == calib::ToScatter::linear;
  const bool power = laws.to_modulus == calib::ToModulus::power;
  TableReader table = top.table("porosity");
  // to_scatter has a law by default, so only one that was written is idle.
  if (!porous && ((table.has("to_scatter") && (window || linear)) || power)) {
    changes_nothing(found, "porosity", "no specimen has sections or a porosity");
    return;
  }
  for (const LawKey& one : {LawKey{"strength_exponent", "to_scatter is not \"window\"", window},
                            LawKey{"linear_offset", "to_scatter is not \"linear\"", linear},
                            LawKey{"linear_slope", "to_scatter is not \"linear\"", linear},
                            LawKey{"modulus_exponent", "to_modulus is not \"power\"", power}}) {
    if (one.in_use) continue;
    if (table.has(one.key)) changes_nothing(found, fmt::format("porosity.{}", one.key), one.law);
    if (std::ranges::count(read.study.calibrate.parameters, one.key) > 0)
      changes_nothing(found, fmt::format("{} in calibrate.parameters", one.key), one.law);
  }
}

void doubt_specimens(TableReader top, const StudyFile& read, Sentences& found) {
  if (read.specimens.empty()) return;
  // In the order of the file, as read.specimens.
  std::vector<TableReader> tables = top.tables("specimen");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const SpecimenFiles& specimen = read.specimens[i];
    const auto say = [&](bool idle, const char* key, const char* why) {
      if (idle && tables[i].has(key))
        changes_nothing(found, fmt::format("{} of specimen {}", key, specimen.id), why);
    };
    say(!specimen.gauge, "gauge_columns", "it has no gauge");
    say(specimen.sections.empty(), "pixel_size_um", "it has no sections");
    say(specimen.sections.empty(), "mask", "it has no sections");
    const calib::PorosityOptions& laws = read.study.porosity;
    if (specimen.porosity && laws.to_scatter == calib::ToScatter::window &&
        !calib::tells_scatter(specimen, laws))
      found.push_back(fmt::format(
          "porosity of specimen {} changes nothing for the scatter: \"window\" needs sections",
          specimen.id));
  }
}

// All angles of a study in radians are small numbers; among others in degrees one is known by the
// 15, 30 ... 90 degrees that it is. The first gives one sentence for the study, the second one for
// each such angle.
void doubt_angles(const StudyFile& read, Sentences& found) {
  constexpr double most = 1.6;  // a little more than a right angle in radians
  // As the file has them, in degrees.
  double largest = 0.0;
  for (const calib::Specimen& specimen : read.study.specimens)
    largest = std::max(largest, std::abs(specimen.orientation) / calib::degree);
  if (largest > 0.0 && largest < most) {
    found.push_back(fmt::format(
        "orientation_deg is in degrees, and the largest is {:.4g}: were radians meant?", largest));
    return;
  }
  for (const calib::Specimen& specimen : read.study.specimens) {
    const double given = specimen.orientation / calib::degree;
    // The angle in degrees if the number was meant in radians, to the nearest multiple of 15.
    const double meant = 15.0 * std::round(given / calib::degree / 15.0);
    if (given == 0.0 || std::abs(given) >= most || std::abs(given / calib::degree - meant) > 0.3)
      continue;
    found.push_back(fmt::format(
        "orientation_deg of specimen {} is {:.4g}, as {:g} degrees are in radians: were radians "
        "meant?",
        specimen.id, given, meant));
  }
}

// Limits of quality control that are given although it is off.
void doubt_reduction(const TableReader& reduction, const StudyFile& read, Sentences& found) {
  for (const char* key : {"largest_modulus_error", "largest_noise"})
    if (!read.reduction.quality_control && reduction.has(key))
      changes_nothing(found, fmt::format("reduction.{}", key), "quality_control is false");
}

// A start outside the bounds is moved to the nearest, and stays there where the tests tell nothing.
void doubt_start(const calib::ParameterInfo& info, const calib::Study& study, Sentences& found) {
  const auto given = study.calibrate.bounds.find(std::string(info.name));
  const auto [lower, upper] =
      given == study.calibrate.bounds.end() ? std::pair(info.lower, info.upper) : given->second;
  const double value = info.of_porosity ? calib::value_of(study.porosity, info.name)
                                        : calib::value_of(study.model, info.name);
  if (value < lower || value > upper)
    found.push_back(fmt::format(
        "{0} starts at {1:g}, the nearest of its bounds, for the study's {2:g} lies outside; it "
        "stays there where the tests tell nothing of it",
        info.name, value < lower ? lower : upper, value));
  if (info.name == "viscosity_s")
    found.emplace_back(
        "viscosity_s is fitted: every simulation runs step by step in time, which takes far longer "
        "than the quasi-static limit; leave it out unless the tests were fast");
}

}  // namespace

std::vector<std::string> study_doubts(TableReader top, const StudyFile& read) {
  const calib::Study& study = read.study;
  Sentences found;
  for (const calib::ParameterInfo& info : calib::all_parameters()) {
    if (is_fitted(study.calibrate, info)) {
      // A model with problems may have no values to compare with bounds.
      if (study.model.problems().empty()) doubt_start(info, study, found);
      continue;
    }
    for (const char* table : {"bounds", "level"})
      if (top.table("calibrate").table(table).has(info.name))
        changes_nothing(found, fmt::format("calibrate.{}.{}", table, info.name),
                        fmt::format("{} is not fitted", info.name));
  }
  doubt_model(top.table("model"), read, found);
  doubt_porosity(top, read, found);
  doubt_angles(read, found);
  doubt_specimens(top, read, found);
  doubt_reduction(top.table("reduction"), read, found);
  return found;
}

}  // namespace havers::io
