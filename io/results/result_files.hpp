// What a run leaves in its folder. Names, columns and keys are fixed.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calib/fit/calibration.hpp"
#include "calib/provenance.hpp"
#include "io/config/read_scene.hpp"
#include "io/images/measure_section.hpp"
#include "io/machine/read_test.hpp"
#include "io/results/sha256.hpp"
#include "sim/simulation.hpp"

namespace havers::io {

/// Of havers, "0.1.0", and of the compiler that built it, "GNU 12.2.0".
std::string version();
std::string compiler_version();

/// The `provenance` object of a result.json.
nlohmann::json provenance_object(const calib::Provenance& provenance);

/// The objects of result.json and of --json. SI units; a number that is not finite is null.
nlohmann::json simulation_json(const SceneFile& file, const sim::Simulation& simulation,
                               const calib::Provenance& provenance);
nlohmann::json calibration_json(const calib::Study& study, const calib::CalibrationResult& result,
                                const calib::Provenance& provenance);
nlohmann::json import_json(const TestFile& file, const calib::Reduction& reduction);
nlohmann::json porosity_json(const calib::SectionPorosity& section, double scatter);

/// `porosity --json` of several sections: their mean, pooled.
nlohmann::json mean_porosity_json(const calib::SpecimenPorosity& mean);
/// A scene in the keys of a scene file, what depends on others filled in. Thresholds given joint by
/// joint are named as the file joints.csv.
nlohmann::json scene_json(const sim::Scene& scene);
/// The same as a scene file. read_scene gives the same scene back, to the last bit where its values
/// came from keys, else to one rounding.
std::string scene_toml(const sim::Scene& scene);

/// curve.csv and joints.csv of a simulation.
void write_curve(const std::filesystem::path& file, const sim::Simulation& simulation);
void write_joints(const std::filesystem::path& file, const sim::Assembly& assembly,
                  const sim::Simulation& simulation);

/// What a file says of each joint.
struct GivenThresholds {
  std::vector<sim::Threshold> thresholds;  ///< By joint. [N/m]
  std::vector<double> lengths;             ///< Of the joints; NaN where it has none. [m]
};
/// From columns joint,f_N,f_T of a CSV file, and length_m, which joints.csv has.
/// @throws InputError.
GivenThresholds read_thresholds(const std::filesystem::path& file);

/// The curves of a fit, and their files in its folder: strain, measured, simulated median and band,
/// residual on a common grid; and the whole measured curve as it was used.
void write_band(const std::filesystem::path& file, const calib::CurveBand& band);
void write_measured(const std::filesystem::path& file, const calib::MeasuredTest& test);
/// Every term of the objective of every specimen, with what its weight is made of, and every
/// replicate at the answer: with them and the curves a fit's cost can be computed by hand.
void write_terms(const std::filesystem::path& file,
                 const std::vector<calib::SpecimenResult>& specimens);
void write_replicates(const std::filesystem::path& file,
                      const std::vector<calib::SpecimenResult>& specimens);
std::string band_file(const std::string& id);      ///< "curves/ID.csv"
std::string measured_file(const std::string& id);  ///< "curves/ID_measured.csv"

/// Writes whole or not at all: a temporary beside the file, then a rename. @throws InputError.
void write_file(const std::filesystem::path& file, const std::string& content);

/// JSON as text, with a line end. What is not UTF-8, as names of files may be, is replaced.
std::string json_text(const nlohmann::json& json);

/// What the report of a finished fit needs, read back from its folder. @throws InputError.
struct FitFolder {
  calib::Study study;  ///< Name, options and porosity; specimens as far as the report shows them.
  calib::CalibrationResult result;
  calib::Provenance provenance;
};
/// Of a fit's folder or its result.json, whatever its name, with curves/ beside it.
/// @throws InputError where these are not there, or not of a fit.
FitFolder read_fit_folder(const std::filesystem::path& folder_or_result);

}  // namespace havers::io
