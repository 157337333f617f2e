// Every key of a scene's tables, declared once: its name, its field and its unit.
//
// `Table` is whatever has key(name, field) and key(name, field, unit): the reader of TOML files
// (table_reader.hpp), the writer and the reader of JSON (json_table.hpp). The strengths of [joints]
// can be given in several ways and are read apart, in scene_tables.cpp.
#pragma once

#include "io/config/key_unit.hpp"
#include "sim/scene.hpp"

namespace havers::io {

template <class Table>
void keys(Table& table, sim::AssemblyOptions& assembly) {
  table.key("layers", assembly.layers);
  table.key("fibres", assembly.fibres);
  table.key("fibre_length_um", assembly.fibre_length, micrometre);
  table.key("fibre_height_um", assembly.fibre_height, micrometre);
  table.key("orientation_deg", assembly.orientation, degree);
  table.key("refinement", assembly.refinement);
}

template <class Table>
void keys(Table& table, sim::Material& material) {
  table.key("young_GPa", material.young, gigapascal);
  table.key("poisson", material.poisson);
  table.key("density_kg_m3", material.density);
  table.key("plane", material.plane);
  table.key("viscosity_s", material.viscosity);
  table.key("layer_contrast", material.layer_contrast);
}

template <class Table>
void keys(Table& table, sim::JointOptions& joints) {
  table.key("scatter", joints.scatter);
  table.key("distribution", joints.distribution);
  table.key("missing", joints.missing);
  table.key("friction", joints.friction);
  table.key("reinforced_boundary", joints.reinforced_boundary);
  table.key("head_tail_shear_MPa", joints.head_tail_shear, megapascal);
  table.key("flank_tension_MPa", joints.flank_tension, megapascal);
  table.key("seed", joints.seed);
}

template <class Table>
void keys(Table& table, sim::Loading& loading) {
  table.key("strain_rate_per_s", loading.strain_rate);
  table.key("lateral", loading.lateral);
  table.key("start", loading.start);
  table.key("max_strain", loading.max_strain);
  table.key("end_fraction", loading.end_fraction);
}

template <class Table>
void keys(Table& table, sim::SolverOptions& solver) {
  table.key("regime", solver.regime);
  table.key("step_s", solver.step);
  table.key("step_accuracy", solver.step_accuracy);
  table.key("contact", solver.contact);
  table.key("tolerance", solver.tolerance);
  table.key("max_iterations", solver.max_iterations);
  table.key("leave_out", solver.leave_out);
}

}  // namespace havers::io
