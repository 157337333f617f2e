// The tables of a scene are read over its defaults. What cannot be judged key by key is left to
// Scene::problems(), which sees them together.
#include "io/config/scene_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "io/config/scene_keys.hpp"
#include "io/results/result_files.hpp"
#include "sim/assembly/assembly.hpp"

namespace havers::io {
namespace {

// The strengths as a file gives them: any two of the four determine the two stresses (M9).
struct Strengths {
  std::optional<double> head_tail, flank, resultant;  // [Pa]
  std::optional<double> ratio;                        // [-]
};

// False when the key is there and its value is unusable.
bool read_strength(TableReader& joints, std::string_view name, std::optional<double>& value,
                   KeyUnit unit = {}) {
  const bool there = joints.has(name);
  if (!joints.key(name, value, unit)) return !there;
  if (*value > 0.0) return true;
  joints.complain(name, fmt::format("is {:g}, must be above 0", from_si(*value, unit)));
  return false;
}

// Two strengths at most; Σ alone says nothing of how it is shared.
bool are_usable(TableReader& joints, const Strengths& strengths) {
  constexpr const char* pairs = "give two of head_tail_MPa, flank_MPa, resultant_MPa and ratio";
  const int given = static_cast<int>(strengths.head_tail.has_value()) +
                    static_cast<int>(strengths.flank.has_value()) +
                    static_cast<int>(strengths.resultant.has_value()) +
                    static_cast<int>(strengths.ratio.has_value());
  if (given > 2)
    joints.complain("", fmt::format("gives {} strengths, two determine all", given), pairs);
  if (given == 1 && strengths.resultant)
    joints.complain("resultant_MPa", "does not determine the strengths alone", pairs);
  return given <= 2 && !(given == 1 && strengths.resultant);
}

// (M9) divides by these. A value that is wrong is named by Scene::problems().
bool can_be_resolved(const sim::AssemblyOptions& assembly) {
  return assembly.layers > 0 && assembly.fibre_length > 0.0 && assembly.fibre_height > 0.0;
}

// One strength alone keeps the other's default; a ratio alone keeps σ₁. `joints` holds the defaults
// and becomes the answer. Precondition: the strengths are usable.
void resolve(const Strengths& given, const sim::AssemblyOptions& assembly,
             sim::JointOptions& joints) {
  // Σ_res = σ₁ + share · σ₂ (M9); the share depends on the wall, not on the stresses.
  const double share = (sim::resultant(assembly, joints) - joints.head_tail) / joints.flank;
  if (given.head_tail) joints.head_tail = *given.head_tail;
  if (given.flank) joints.flank = *given.flank;
  if (given.resultant && given.head_tail)
    joints.flank = (*given.resultant - joints.head_tail) / share;
  if (given.resultant && given.flank) joints.head_tail = *given.resultant - share * joints.flank;
  if (given.resultant && given.ratio)
    joints.head_tail = sim::head_tail_from_resultant(assembly, *given.resultant, *given.ratio);
  // (M9) r is proportional to σ₁: scaling σ₁ gives the ratio while σ₂ stays as given.
  if (given.flank && given.ratio)
    joints.head_tail *= *given.ratio / sim::ratio(assembly, joints);
  else if (given.ratio)
    joints.flank = sim::flank_from_ratio(assembly, joints.head_tail, *given.ratio);
}

// `joints` stays as it is where the keys do not give two stresses. Precondition: the wall was read.
void read_strengths(TableReader& table, const sim::AssemblyOptions& assembly,
                    sim::JointOptions& joints) {
  Strengths given;
  bool good = read_strength(table, "head_tail_MPa", given.head_tail, megapascal);
  good &= read_strength(table, "flank_MPa", given.flank, megapascal);
  good &= read_strength(table, "resultant_MPa", given.resultant, megapascal);
  good &= read_strength(table, "ratio", given.ratio);
  if (!are_usable(table, given) || !good || !can_be_resolved(assembly)) return;

  // Σ may be less than the stress that is given with it: the other would be negative.
  sim::JointOptions resolved = joints;
  resolve(given, assembly, resolved);
  if (resolved.head_tail > 0.0 && resolved.flank > 0.0)
    joints = resolved;
  else
    table.complain("resultant_MPa",
                   fmt::format("is {:g}, less than the given stress contributes alone",
                               from_si(*given.resultant, megapascal)),
                   "resultant = head_tail + (1 + 1/layers)/2 fibre_length/fibre_height flank");
}

// @return the lengths that the file gives the joints
std::vector<double> read_thresholds_file(TableReader& table,
                                         std::vector<sim::Threshold>& thresholds) {
  std::filesystem::path file;
  if (!table.key("thresholds_file", file) || !table.require_file("thresholds_file", file))
    return {};
  try {
    GivenThresholds given = read_thresholds(file);
    thresholds = std::move(given.thresholds);
    return std::move(given.lengths);
  } catch (const InputError& error) {
    table.complain(error.problems());
    return {};
  }
}

// A file of another wall may have as many joints; their lengths tell the walls apart. A length is
// NaN where the file has none, and is then not compared.
void require_joints(TableReader& table, const std::vector<double>& lengths,
                    const sim::Scene& scene) {
  constexpr double rounding = 1e-6;
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double length = assembly.joints[i].length;
    if (!(std::abs(lengths[i] - length) > rounding * length)) continue;
    table.complain("thresholds_file",
                   fmt::format("has joint {} {:.6g} µm long, the assembly {:.6g} µm: it is of "
                               "another wall",
                               i, 1e6 * lengths[i], 1e6 * length),
                   "write a matching file with havers simulate: joints.csv");
    return;
  }
}

}  // namespace

void read_scene_tables(TableReader& tables, sim::Scene& scene) {
  TableReader assembly = tables.table("assembly");
  keys(assembly, scene.assembly);
  TableReader material = tables.table("material");
  keys(material, scene.material);
  TableReader joints = tables.table("joints");
  keys(joints, scene.joints);
  read_strengths(joints, scene.assembly, scene.joints);
  const std::vector<double> lengths = read_thresholds_file(joints, scene.joints.thresholds);
  TableReader loading = tables.table("loading");
  keys(loading, scene.loading);
  TableReader solver = tables.table("solver");
  keys(solver, scene.solver);

  // Asked once all tables are read. The joints are compared only in a scene without problems, as
  // the wall is built for that.
  const std::vector<sim::Scene::Problem> problems = scene.problems();
  for (const sim::Scene::Problem& problem : problems)
    tables.complain(problem.key, problem.what, problem.hint);
  if (problems.empty() && !lengths.empty()) require_joints(joints, lengths, scene);
}

}  // namespace havers::io
