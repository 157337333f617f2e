// The ways to compute one scene that a bench compares.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene.hpp"

namespace havers::sim {

/// One way to compute the scene.
struct BenchSetting {
  Regime regime = Regime::dynamic;
  ContactMethod contact = ContactMethod::active_set;
  double tolerance = 1e-8;          ///< Of the contact solver. [-]
  std::optional<double> step = {};  ///< h; none in the quasi-static limit or where the program
                                    ///< chooses it. [s]
  int refinement = 1;               ///< k of the mesh (section 1).
  bool leave_out = true;            ///< Section 7.
  bool leap = false;                ///< With a step: over uniform motion before the first break.

  bool operator==(const BenchSetting&) const = default;
};

/// "active set, h = 20 ns, 8 triangles a fibre": the setting in words.
std::string to_string(const BenchSetting& setting);

/// Whether it runs in time with steps that the program chooses (section 8).
bool has_chosen_steps(const BenchSetting& setting);

/// The same, with nothing left out (section 7).
BenchSetting without_omissions(BenchSetting setting);

/// The scene's own mesh and tolerance, solved directly: in the limit, or in chosen steps.
BenchSetting direct_setting(const Scene& scene);

/// The scene with the setting's regime, solver, steps and mesh in place of its own.
Scene with_setting(const BenchSetting& setting, Scene scene);

/// h that others are parts of: the scene's own or, where it has none, L/(4c); in the quasi-static
/// limit a hundredth of the way to the first break. [s]
double base_step(const Scene& scene);

/// The settings that a scene is computed with. For a scene in the limit: the limit, steps in time,
/// and the limit on finer meshes. For one in time: the direct solver and sweeps, each by several
/// steps, and finer meshes last; the first setting leaves nothing out and the second differs in
/// that alone, as only neighbours are compared for what omissions change.
std::vector<BenchSetting> bench_settings(const Scene& scene);

}  // namespace havers::sim
