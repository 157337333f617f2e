#include "cli/load_study.hpp"

#include <tbb/parallel_for.h>

#include <utility>

#include "calib/experiment/join_logger.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"

namespace havers::cli {
namespace {

// What one specimen's files gave; filled by one thread, so that the order of threads shows nowhere.
struct Outcome {
  calib::Specimen specimen;
  std::vector<std::vector<std::uint8_t>> overlays;
  std::vector<std::string> warnings;
  std::vector<io::Problem> problems;
};

void collect(std::vector<io::Problem>& all, const std::vector<io::Problem>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void override_sizes(calib::RawTest& test, const io::SpecimenFiles& files) {
  if (files.width) test.width = files.width;
  if (files.thickness) test.thickness = files.thickness;
  if (files.gauge_length) test.gauge_length = files.gauge_length;
}

calib::RawTest read_specimen(const io::SpecimenFiles& files, Outcome& outcome) {
  calib::RawTest raw = io::read_test(files.test, files.columns).test;
  override_sizes(raw, files);
  if (!files.gauge) return raw;
  const io::TestFile logger = io::read_test(*files.gauge, files.gauge_columns);
  calib::JoinedTest joined = calib::join_logger(raw, logger.test);
  for (const std::string& problem : joined.problems)
    outcome.problems.push_back({files.gauge->string(), problem, ""});
  return std::move(joined.test);
}

void read_and_reduce(const io::SpecimenFiles& files, const calib::ReductionOptions& options,
                     Outcome& outcome) {
  try {
    const calib::RawTest raw = read_specimen(files, outcome);
    calib::Reduction reduction = calib::reduce_test(raw, options);
    for (const std::string& problem : reduction.problems)
      outcome.problems.push_back({files.test.string(), problem, ""});
    for (const std::string& warning : reduction.test.warnings)
      outcome.warnings.push_back(files.test.string() + ": " + warning);
    outcome.specimen.test = std::move(reduction.test);
  } catch (const io::InputError& error) {
    collect(outcome.problems, error.problems());
  }
}

void measure(const std::filesystem::path& section, const io::SectionOptions& options,
             Outcome& outcome) {
  try {
    io::SectionMeasurement measured = io::measure_section(section, options);
    for (const std::string& warning : measured.porosity.warnings)
      outcome.warnings.push_back(section.string() + ": " + warning);
    outcome.specimen.sections.push_back(std::move(measured.porosity));
    outcome.overlays.push_back(std::move(measured.overlay_png));
  } catch (const io::InputError& error) {
    collect(outcome.problems, error.problems());
  }
}

Outcome load_specimen(const calib::Specimen& declared, const io::SpecimenFiles& files,
                      const sim::AssemblyOptions& fibres,
                      const calib::ReductionOptions& reduction) {
  Outcome outcome;
  outcome.specimen = declared;
  read_and_reduce(files, reduction, outcome);
  io::SectionOptions options;
  options.pixel_size = files.pixel_size;
  options.window_length = fibres.fibre_length;
  options.window_height = fibres.fibre_height;
  for (const auto& section : files.sections) measure(section, options, outcome);
  if (!files.sections.empty()) outcome.specimen.porosity.reset();  // what is measured counts
  return outcome;
}

}  // namespace

LoadedStudy load_study(const std::filesystem::path& file, const io::Overrides& overrides) {
  io::StudyFile read = io::read_study(file, overrides);
  std::vector<Outcome> outcomes(read.specimens.size());
  tbb::parallel_for(std::size_t{0}, outcomes.size(), [&](std::size_t i) {
    outcomes[i] = load_specimen(read.study.specimens[i], read.specimens[i],
                                read.study.model.assembly, read.reduction);
  });

  LoadedStudy loaded;
  loaded.study = std::move(read.study);
  loaded.inputs = {file};
  std::vector<io::Problem> problems;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    collect(problems, outcomes[i].problems);
    const io::SpecimenFiles& files = read.specimens[i];
    loaded.inputs.push_back(files.test);
    if (files.gauge) loaded.inputs.push_back(*files.gauge);
    loaded.inputs.insert(loaded.inputs.end(), files.sections.begin(), files.sections.end());
    loaded.warnings.insert(loaded.warnings.end(), outcomes[i].warnings.begin(),
                           outcomes[i].warnings.end());
    if (!outcomes[i].overlays.empty()) loaded.overlays[files.id] = std::move(outcomes[i].overlays);
    loaded.study.specimens[i] = std::move(outcomes[i].specimen);
  }
  if (!problems.empty()) throw io::InputError(std::move(problems));
  return loaded;
}

}  // namespace havers::cli
