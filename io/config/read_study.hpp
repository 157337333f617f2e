// Study files (TOML): what a study names, before its files are opened.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/study/study.hpp"
#include "calib/synthetic/laboratory_record.hpp"
#include "io/config/read_scene.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"

namespace havers::io {

/// A [[specimen]] table. Paths are resolved against the study's folder. SI units.
struct SpecimenFiles {
  std::string id;
  std::filesystem::path test;
  std::optional<std::filesystem::path> gauge;
  ReadOptions columns{};                      ///< [specimen.columns], and which in `test`.
  ReadOptions gauge_columns{.logger = true};  ///< [specimen.gauge_columns].
  std::optional<double> width, thickness, gauge_length;  ///< Override what the test file says. [m]
  std::optional<double> orientation;                     ///< Not given: 0, with a warning. [rad]
  std::vector<std::filesystem::path> sections;
  std::optional<double> pixel_size;           ///< [m]
  std::optional<std::filesystem::path> mask;  ///< Of all its sections: white where the bone is.
  std::optional<double> porosity;  ///< For specimens without sections; what `synthesize` draws. [-]
  calib::Use use = calib::Use::fit;
  std::optional<bool> broke;  ///< Where the test's record shows it wrong (X20).
};

/// [synthesize]: how `havers synthesize` dresses the model's answers as a laboratory's files. SI
/// units.
struct SynthesizeOptions {
  calib::Laboratory laboratory;
  double pore_radius = 8e-6;  ///< Mean radius of the drawn pores. [m]
  double modulus_cv = 0.0;    ///< Coefficient of variation of E between specimens. [-]
  int section_pixels = 512;   ///< Side of a drawn section.
};

/// A study as its file says it: tests and sections are named, and not yet read.
struct StudyFile {
  calib::Study
      study;  ///< Everything but the specimens, which hold only id, use, orientation, porosity.
  std::vector<SpecimenFiles> specimens;
  SynthesizeOptions synthesize;
  calib::ReductionOptions reduction;
  SectionOptions sections;  ///< [sections]; pixel size, mask and window are the specimen's.
  std::vector<std::filesystem::path> inputs;  ///< The study, and what it names that is there.
  std::vector<std::filesystem::path> names;   ///< Of files, as the study writes them.
  bool rate_is_given = false;                 ///< model.loading.strain_rate_per_s.
  std::vector<std::string> warnings;          ///< A sentence for each key that changes nothing.
};

/// Whether the named test and section files must exist (all commands but `synthesize`).
enum class Files { must_exist, will_be_written };

/// Reads a study. @throws InputError with every problem, as read_scene.
StudyFile read_study(const std::filesystem::path& file, const Overrides& overrides = {},
                     Files files = Files::must_exist);

/// The same, of files that must exist, as far as it can be read; what is wrong goes to `problems`.
StudyFile read_study(const std::filesystem::path& file, const Overrides& overrides,
                     std::vector<Problem>& problems);

class TableReader;

/// [reduction], of a study and of `--set` for `havers import`; what is wrong is collected in the
/// table's file.
void read_reduction(TableReader table, calib::ReductionOptions& options);

}  // namespace havers::io
