#include <cmath>

#include "io/results/json_table.hpp"
#include "io/results/measured_keys.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {
namespace {

nlohmann::json column_json(const Column& column) {
  return {{"name", column.name}, {"unit", column.unit}, {"quantity", to_string(column.quantity)}};
}

}  // namespace

nlohmann::json import_json(const TestFile& file, const calib::Reduction& reduction) {
  nlohmann::json json =
      json_of(reduction.test);  // modulus_Pa, strength_Pa, ... , corrections and warnings
  // What is not known is null. Without a curve that is everything but the area and the lists; in a
  // test that was not reduced, every 0. In a reduced test it is a 0 only where the channel or size
  // that the value follows from may be missing.
  const bool curve = !reduction.test.strain.empty(), reduced = curve && reduction.problems.empty();
  for (const auto& [key, value] : json.items()) {
    const bool area = key == "area_m2";
    const bool may_lack = area || key == "max_force_N" || key == "strain_rate_per_s";
    if ((value == 0.0 && (may_lack || !reduced)) || (!value.is_array() && !curve && !area))
      value = nullptr;
  }
  json["file"] = file.file;
  json["layout"] = file.layout;
  json["encoding"] = file.encoding;
  json["delimiter"] = file.delimiter;
  json["decimal"] = file.decimal;
  json["columns"] = nlohmann::json::array();
  for (const Column& column : file.columns) json["columns"].push_back(column_json(column));
  json["rows"] = file.rows;
  json["specimen_id"] = file.test.specimen_id;
  json["width_m"] = json_of(file.test.width);
  json["thickness_m"] = json_of(file.test.thickness);
  json["gauge_length_m"] = json_of(file.test.gauge_length);
  json["problems"] = reduction.problems;
  return json;
}

nlohmann::json porosity_json(const calib::SectionPorosity& section, double scatter) {
  nlohmann::json json = json_of(section);
  // (K5) Pores larger than a window take joints away, and tell no scatter.
  const calib::SpecimenPorosity alone = calib::pool_sections({section});
  json["scatter"] = json_of(calib::removes_joints(alone) ? std::nan("") : scatter);
  json["missing_joints"] = calib::missing_joints(alone);
  return json;
}

nlohmann::json mean_porosity_json(const calib::SpecimenPorosity& mean) {
  return {{"porosity", mean.porosity},
          {"porosity_standard_error", mean.porosity_standard_error},
          {"window_sd", json_of(mean.window_sd)},
          {"scatter",
           json_of(calib::removes_joints(mean) ? std::nan("") : calib::scatter_of(mean, {}))},
          {"missing_joints", calib::missing_joints(mean)}};
}

}  // namespace havers::io
