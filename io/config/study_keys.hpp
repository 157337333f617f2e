// The keys of a study's own tables, declared once as in scene_keys.hpp.
#pragma once

#include "calib/study/study.hpp"
#include "io/config/key_unit.hpp"
#include "io/config/read_study.hpp"

namespace havers::io {

/// [porosity]: how porosity becomes scatter and acts on the modulus, (K3) and (K4).
template <class Table>
void keys(Table& table, calib::PorosityOptions& porosity) {
  table.key("to_scatter", porosity.to_scatter);
  table.key("to_modulus", porosity.to_modulus);
  table.key("strength_exponent", porosity.strength_exponent);  // n of (K3)
  table.key("linear_offset", porosity.linear_offset);          // d₀
  table.key("linear_slope", porosity.linear_slope);            // k
  table.key("modulus_exponent", porosity.modulus_exponent);    // m of (K4)
}

/// [sections]: how images are measured.
template <class Table>
void keys(Table& table, SectionOptions& options) {
  table.key("threshold", options.threshold);
  table.key("pores", options.pores);
  table.key("rim_um", options.rim, micrometre);
  table.key("crack_slenderness", options.crack_slenderness);
  table.key("any_pixel_size", options.any_pixel_size);
  table.key("fills_image", options.fills_image);
}

/// [calibrate.options]; the number of threads is no option of a study, since it never changes a
/// number.
template <class Table>
void keys(Table& table, calib::CalibrateOptions& options) {
  table.key("terms", options.terms);                // of the objective (F4)
  table.key("replicates", options.replicates);      // 0: as many as needed
  table.key("global", options.global);              // how the neighbourhood of the answer is found
  table.key("local", options.local);                // how a start is refined from there
  table.key("smooth", options.smooth);              // least squares after the local search
  table.key("profiles", options.profiles);          // likelihood of each parameter
  table.key("common_seeds", options.common_seeds);  // the same at every point of a search (F2)
  table.key("confirm", options.confirm);            // how many simulations in time
  table.key("budget", options.budget);  // points, each with all specimens and replicates
  table.key("seed", options.seed);
}

/// [synthesize]: how tests are recorded, and what the sections look like.
template <class Table>
void keys(Table& table, SynthesizeOptions& options) {
  table.key("force_noise_N", options.laboratory.force_noise);
  table.key("strain_noise", options.laboratory.strain_noise);
  table.key("preload_N", options.laboratory.preload);
  table.key("toe_strain", options.laboratory.toe_strain);
  table.key("sampling_s", options.laboratory.sampling);
  table.key("crosshead_mm_per_min", options.laboratory.crosshead_rate, millimetre_per_minute);
  table.key("pore_radius_um", options.pore_radius, micrometre);
  table.key("modulus_cv", options.modulus_cv);          // between specimens
  table.key("section_pixels", options.section_pixels);  // side of a square image
}

/// [reduction]: every correction has its switch.
template <class Table>
void keys(Table& table, calib::ReductionOptions& options) {
  table.key("window_low", options.window_low);  // both of the strength (X3)
  table.key("window_high", options.window_high);
  table.key("straightness", options.straightness);                    // (X5)
  table.key("remove_toe", options.remove_toe);                        // (X9)
  table.key("cut_after_break", options.cut_after_break);              // (X20)
  table.key("break_part", options.break_part);                        // of the strength (X20)
  table.key("remove_spikes", options.remove_spikes);                  // (X11)
  table.key("spread_repeated_times", options.spread_repeated_times);  // (X12)
  table.key("mend_slips", options.mend_slips);                        // (X13), (X14)
  table.key("machine_compliance_mm_per_kN", options.machine_compliance, millimetre_per_kilonewton);
  table.key("quality_control", options.quality_control);              // (X16)
  table.key("largest_modulus_error", options.largest_modulus_error);  // of the modulus (X16)
  table.key("largest_noise", options.largest_noise);                  // of the strength (X16)
}

/// Reads a name; a whole number stands for one and is read as its digits. False where the key is
/// absent or wrong.
template <class Table>
bool name_or_number(Table& table, const std::string& key, std::string& name) {
  if (!table.is_name_or_number(key)) return false;
  if (!table.has(key) || table.is_text(key)) return table.key(key, name);
  int number = 0;
  const bool given = table.key(key, number);
  if (given) name = std::to_string(number);
  return given;
}

/// [specimen.columns]: a column's name or number, and its unit: force = "Channel 3", force_unit =
/// "500 N/V". A unit alone is that of the column that is found by its name.
template <class Table>
void keys(Table& table, ReadOptions& options) {
  // The other quantities have no key: a signal in volts is named as the force or strain it
  // measures.
  for (const Quantity quantity :
       {Quantity::time, Quantity::force, Quantity::extension, Quantity::strain, Quantity::stress}) {
    ColumnHint hint;
    const bool given = name_or_number(table, to_string(quantity), hint.column);
    table.key(to_string(quantity) + "_unit", hint.unit);
    if (given)
      options.columns[quantity] = hint;
    else if (!hint.unit.empty())
      options.units[quantity] = hint.unit;
  }
}

/// Which of a file's specimens: a text is its name, a number its place in the file, from 1. They
/// are kept apart, as specimens may be called by numbers.
template <class Table>
void specimen_in_file(Table& table, ReadOptions& options) {
  const char* key = "specimen_in_file";
  if (!table.is_name_or_number(key)) return;
  if (table.is_text(key))
    table.key(key, options.specimen);
  else
    table.key(key, options.specimen_number);
}

/// [[specimen]], but its tables columns and gauge_columns.
template <class Table>
void keys(Table& table, SpecimenFiles& specimen) {
  table.key("id", specimen.id);
  table.key("test", specimen.test);  // the testing machine's file
  specimen_in_file(table, specimen.columns);
  table.key("gauge", specimen.gauge);  // a second logger's file
  table.key("width_mm", specimen.width, millimetre);
  table.key("thickness_mm", specimen.thickness, millimetre);
  table.key("gauge_length_mm", specimen.gauge_length, millimetre);
  table.key("orientation_deg", specimen.orientation, degree);
  table.key("sections", specimen.sections);
  table.key("pixel_size_um", specimen.pixel_size, micrometre);
  table.key("mask", specimen.mask);          // of all its sections
  table.key("porosity", specimen.porosity);  // of a specimen without sections
  table.key("use", specimen.use);
  table.key("broke", specimen.broke);  // overrides what the record shows (X20)
}

}  // namespace havers::io
