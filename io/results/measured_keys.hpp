// The keys of what is measured: a test, and a section. A number without a unit in its name is a
// ratio or a count. What each value means stands with its field in calib/experiment and
// calib/porosity.
#pragma once

#include "calib/experiment/measured_test.hpp"
#include "calib/porosity/scatter_map.hpp"
#include "io/config/key_unit.hpp"

namespace havers::io {

/// A correction that was applied to a test.
template <class Table>
void keys(Table& table, calib::Correction& correction) {
  table.key("what", correction.what);
  table.key("detail", correction.detail);
}

/// A reduced test, for `measured` of a specimen and `import --json`; its curve is not among them.
template <class Table>
void keys(Table& table, calib::MeasuredTest& test) {
  table.key("area_m2", test.area);
  table.key("modulus_Pa", test.modulus);  // (X4)
  table.key("modulus_standard_error_Pa", test.modulus_standard_error);
  table.key("window_low", test.window_low);    // a strain
  table.key("window_high", test.window_high);  // a strain
  table.key("max_force_N", test.max_force);
  table.key("strength_Pa", test.strength);
  table.key("strength_standard_error_Pa", test.strength_standard_error);  // (X7)
  table.key("failure_strain", test.failure_strain);
  table.key("broke", test.broke);                                   // (X20)
  table.key("strain_rate_per_s", test.strain_rate);                 // (X8)
  table.key("energy_to_failure_J_per_m3", test.energy_to_failure);  // (X15)
  table.key("linearity", test.linearity);                           // (X10)
  table.key("corrections", test.corrections);
  table.key("warnings", test.warnings);
  table.key("unit_doubt", test.unit_doubt);  // (X22)
}

template <class Table>
void keys(Table& table, calib::PoreClass& pores) {
  table.key("name", pores.name);
  table.key("count", pores.count);
  table.key("area_um2", pores.area, square_micrometre);
}

template <class Table>
void keys(Table& table, calib::Zone& zone) {
  table.key("name", zone.name);
  table.key("porosity", zone.porosity);
  table.key("bone_area_um2", zone.bone_area, square_micrometre);
}

/// A measured section, for `porosity --json` and the specimens of a study.
template <class Table>
void keys(Table& table, calib::SectionPorosity& section) {
  table.key("file", section.file);
  table.key("pixel_size_um", section.pixel_size, micrometre);
  table.key("method", section.method);        // how the threshold was found
  table.key("threshold", section.threshold);  // a depth: 0 in bone, 1 in pores
  table.key("porosity", section.porosity);    // Ct.Po
  table.key("porosity_standard_error", section.porosity_standard_error);
  table.key("porosity_by_grey", section.porosity_by_grey);  // a check without a threshold
  table.key("pore_count", section.pore_count);              // Po.N
  table.key("pore_density_per_m2", section.pore_density);
  table.key("pore_area_um2", section.pore_area, square_micrometre);
  table.key("bone_area_um2", section.bone_area, square_micrometre);    // Ct.Ar
  table.key("total_area_um2", section.total_area, square_micrometre);  // Tt.Ar
  table.key("marrow_area_um2", section.marrow_area, square_micrometre);
  table.key("mean_pore_area_um2", section.mean_pore_area, square_micrometre);  // Po.Ar
  table.key("pore_area_sd_um2", section.pore_area_sd, square_micrometre);
  table.key("mean_pore_diameter_um", section.mean_pore_diameter, micrometre);  // Po.Dm
  table.key("pore_diameter_sd_um", section.pore_diameter_sd, micrometre);
  table.key("pore_area_ratio_um2", section.pore_area_ratio, square_micrometre);  // a* (K2)
  table.key("window_area_um2", section.window_area, square_micrometre);          // A
  table.key("window_sd", section.window_sd);                                     // (K1)
  table.key("window_sd_standard_error", section.window_sd_standard_error);
  table.key("crack_count", section.crack_count);
  table.key("crack_area_um2", section.crack_area, square_micrometre);  // not in the pore area
  table.key("speck_count", section.speck_count);  // too small to be told from noise
  table.key("classes", section.classes);          // by the diameter of pores
  table.key("zones", section.zones);              // parts of the section
  table.key("density_kg_per_m3", section.density);
  table.key("density_residual_kg_per_m3", section.density_residual);
  table.key("warnings", section.warnings);
  table.key("doubtful", section.doubtful);  // whether a warning doubts the porosity itself
}

}  // namespace havers::io
