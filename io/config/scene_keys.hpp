// Every key of a scene's tables, declared once: its name, its field and its unit. What a field
// means and its default stand in sim/scene.hpp, what it may be in Scene::problems().
//
// `Table` is whatever has key(name, field) and key(name, field, unit): the reader of TOML files
// (table_reader.hpp), the writer and the reader of JSON (json_table.hpp). The strengths of [joints]
// can be given in several ways and are read apart, in scene_tables.cpp.
#pragma once

#include "io/config/key_unit.hpp"
#include "sim/scene.hpp"

namespace havers::io {

/// [assembly]: the wall of fibres, section 1 of sim/README.md.
template <class Table>
void keys(Table& table, sim::AssemblyOptions& assembly) {
  table.key("layers", assembly.layers);
  table.key("fibres", assembly.fibres);
  table.key("fibre_length_um", assembly.fibre_length, micrometre);
  table.key("fibre_height_um", assembly.fibre_height, micrometre);
  table.key("orientation_deg", assembly.orientation, degree);
  table.key("refinement", assembly.refinement);  // 1, 2 or 4: 8 k² triangles a fibre
}

/// [material] of the fibres, section 2.
template <class Table>
void keys(Table& table, sim::Material& material) {
  table.key("young_GPa", material.young, gigapascal);
  table.key("poisson", material.poisson);
  table.key("density_kg_m3", material.density);
  table.key("plane", material.plane);
  table.key("viscosity_s", material.viscosity);
  table.key("layer_contrast", material.layer_contrast);  // of every second layer
}

/// [joints] without the strengths σ₁, σ₂, Σ and r, sections 3 and 4. A stress here is a force per
/// thickness over the length of the joint.
template <class Table>
void keys(Table& table, sim::JointOptions& joints) {
  table.key("scatter", joints.scatter);
  table.key("distribution", joints.distribution);
  table.key("missing", joints.missing);  // a share of the joints (M13)
  table.key("friction", joints.friction);
  table.key("reinforced_boundary", joints.reinforced_boundary);          // absent: at 0° alone
  table.key("head_tail_shear_MPa", joints.head_tail_shear, megapascal);  // absent: by f₂
  table.key("flank_tension_MPa", joints.flank_tension, megapascal);      // absent: by f₁
  table.key("seed", joints.seed);
}

/// [loading] and the end of a run, section 5.
template <class Table>
void keys(Table& table, sim::Loading& loading) {
  table.key("strain_rate_per_s", loading.strain_rate);
  table.key("lateral", loading.lateral);
  table.key("start", loading.start);
  table.key("max_strain", loading.max_strain);
  table.key("end_fraction", loading.end_fraction);  // of the strength
}

/// [solver]: how the answer is computed; what is left out, section 7.
template <class Table>
void keys(Table& table, sim::SolverOptions& solver) {
  table.key("regime", solver.regime);
  table.key("step_s", solver.step);  // absent: chosen by step_accuracy
  table.key("step_accuracy", solver.step_accuracy);
  table.key("contact", solver.contact);
  table.key("tolerance", solver.tolerance);  // of the relative residual (M11)
  table.key("max_iterations", solver.max_iterations);
  table.key("leave_out", solver.leave_out);
}

}  // namespace havers::io
