// Specimens are read in parallel, each into an outcome of its own, and put together in the study's
// order afterwards. Problems of all files are collected and thrown at once, so that none hides
// another.
#include "cli/load_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "calib/experiment/join_logger.hpp"
#include "calib/fit/scenes.hpp"
#include "cli/loaded_doubts.hpp"
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
  std::vector<std::string> rejections;  // why the test cannot be used, though it can be read
  TestRecord record;
  OwnWords own;
};

// What a file complains of, with its place in the study.
void collect(Outcome& outcome, const std::vector<io::Problem>& more,
             const std::filesystem::path& file, const char* key) {
  for (io::Problem problem : more) {
    if (problem.where.starts_with(file.string()))
      problem.hint += fmt::format("{}it is the {} of specimen {}", problem.hint.empty() ? "" : "; ",
                                  key, outcome.specimen.id);
    outcome.problems.push_back(std::move(problem));
  }
}

io::ReadOptions with_sizes(io::ReadOptions options, const io::SpecimenFiles& files) {
  options.width = files.width;
  options.thickness = files.thickness;
  options.gauge_length = files.gauge_length;
  return options;
}

// Not even where a folder above may not be searched.
bool is_file(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

// A file that is not there was complained of with the study.
std::optional<io::TestFile> read_file(const std::filesystem::path& file,
                                      const io::ReadOptions& options, const char* key,
                                      Outcome& outcome) {
  if (!is_file(file)) return std::nullopt;
  try {
    return io::read_test(file, options);
  } catch (const io::InputError& error) {
    collect(outcome, error.problems(), file, key);
    return std::nullopt;
  }
}

// Reads the raw test and joins it with its logger if it has one. If one of the files cannot be read
// the record stays empty.
void read_specimen(const io::SpecimenFiles& files, const calib::ReductionOptions& reduction,
                   Outcome& outcome) {
  io::ReadOptions options = with_sizes(files.columns, files);
  options.has_logger = files.gauge.has_value();
  std::optional<io::TestFile> test = read_file(files.test, options, "test", outcome), logger;
  if (files.gauge)
    logger = read_file(*files.gauge, with_sizes(files.gauge_columns, files), "gauge", outcome);
  if (!test || files.gauge.has_value() != logger.has_value()) return;
  outcome.own = {.number = test->number, .test_id = test->test.specimen_id};
  if (logger) outcome.own.logger_id = logger->test.specimen_id;
  outcome.record.raw = std::move(test->test);
  if (!logger) return;
  calib::JoinedTest joined = calib::join_logger(outcome.record.raw, logger->test, reduction);
  outcome.record.raw = std::move(joined.test);
  outcome.record.clocks = std::move(joined.clocks);
  outcome.rejections = std::move(joined.problems);
}

// Reduces the record to stress and strain. If that is impossible, `rejections` say why.
void reduce(const io::SpecimenFiles& files, const calib::ReductionOptions& options,
            Outcome& outcome) {
  calib::Reduction reduction = calib::reduce_test(outcome.record.raw, options);
  outcome.rejections = std::move(reduction.problems);
  for (const std::string& warning : reduction.test.warnings)
    outcome.warnings.push_back(files.test.string() + ": " + warning);
  // What the study says counts before what the record shows.
  reduction.test.broke = files.broke.value_or(reduction.test.broke);
  outcome.specimen.broke = reduction.test.broke;
  outcome.specimen.test = std::move(reduction.test);
}

void measure(const std::filesystem::path& section, const io::SectionOptions& options,
             Outcome& outcome) {
  if (!is_file(section)) return;  // as with tests
  try {
    for (io::SectionMeasurement& measured : io::measure_sections(section, options)) {
      for (const std::string& warning : measured.porosity.warnings)
        outcome.warnings.push_back(measured.porosity.file + ": " + warning);
      outcome.specimen.sections.push_back(std::move(measured.porosity));
      outcome.overlays.push_back(std::move(measured.overlay_png));
    }
  } catch (const io::InputError& error) {
    collect(outcome, error.problems(), section, "section");
  }
}

// What is measured counts; a number beside it was perhaps found by other means, or of other bone.
void take_measured_porosity(Outcome& outcome) {
  constexpr double apart = 1.5;
  calib::Specimen& specimen = outcome.specimen;
  if (specimen.sections.empty() || !specimen.porosity) return;
  const double given = *specimen.porosity;
  const double measured = calib::pool_sections(specimen.sections).porosity;
  specimen.porosity.reset();
  if (std::max(given, measured) > apart * std::min(given, measured))
    outcome.warnings.push_back(fmt::format(
        "specimen {}: its sections have a porosity of {:.2g}, which counts, and {:.2g} is given: "
        "check both",
        specimen.id, measured, given));
}

// Whether the study's own mistakes leave its sections what they are measured with.
bool can_be_measured(const io::SpecimenFiles& files, const io::StudyFile& study) {
  const sim::AssemblyOptions& fibres = study.study.model.assembly;
  return (!files.pixel_size || *files.pixel_size > 0.0) && (!files.mask || is_file(*files.mask)) &&
         study.sections.rim >= 0.0 && study.sections.crack_slenderness >= 0.0 &&
         fibres.fibre_length > 0.0 && fibres.fibre_height > 0.0;
}

// Of a study that is not sound the files are looked at too: they may have problems of their own.
Outcome load_specimen(const calib::Specimen& declared, const io::SpecimenFiles& files,
                      const io::StudyFile& study, bool sound) {
  Outcome outcome;
  outcome.specimen = declared;
  read_specimen(files, study.reduction, outcome);
  // A test is reduced only by sound settings; if it is not, its record's own warnings are kept.
  if (sound && outcome.problems.empty() && outcome.rejections.empty())
    reduce(files, study.reduction, outcome);
  else
    for (const std::string& warning : outcome.record.raw.warnings)
      outcome.warnings.push_back(files.test.string() + ": " + warning);
  if (!can_be_measured(files, study)) return outcome;
  io::SectionOptions options = study.sections;
  options.pixel_size = files.pixel_size;
  options.mask = files.mask;
  options.window_length = study.study.model.assembly.fibre_length;
  options.window_height = study.study.model.assembly.fibre_height;
  for (const auto& section : files.sections) measure(section, options, outcome);
  take_measured_porosity(outcome);
  return outcome;
}

// A test that cannot be used does not stop the others.
void leave_out(const io::SpecimenFiles& files, const Outcome& outcome, LoadedStudy& loaded) {
  const std::string why = fmt::format("{}", fmt::join(outcome.rejections, "; "));
  loaded.file_notes.push_back(
      fmt::format("{}: specimen {} is left out: {}", files.test.string(), files.id, why));
  loaded.left_out.push_back({"specimen " + files.id, why});
}

void take_specimen(const io::SpecimenFiles& files, Outcome outcome, LoadedStudy& loaded) {
  loaded.file_notes.insert(loaded.file_notes.end(), outcome.warnings.begin(),
                           outcome.warnings.end());
  if (!outcome.rejections.empty()) {
    leave_out(files, outcome, loaded);
    return;
  }
  if (!outcome.overlays.empty()) loaded.overlays[files.id] = std::move(outcome.overlays);
  loaded.records[files.id] = std::move(outcome.record);
  loaded.study.specimens.push_back(std::move(outcome.specimen));
}

// What is known whether the study is sound or not.
std::vector<std::string> notes_of(const LoadedStudy& loaded, const std::vector<Outcome>& outcomes) {
  std::vector<std::string> notes = loaded.notes;
  for (const Outcome& outcome : outcomes)
    notes.insert(notes.end(), outcome.warnings.begin(), outcome.warnings.end());
  return notes;
}

// Rejections are problems where they leave nothing to fit.
void require_specimens(const LoadedStudy& loaded, const std::filesystem::path& file) {
  const bool some = std::ranges::any_of(
      loaded.study.specimens, [](const auto& specimen) { return specimen.use == calib::Use::fit; });
  if (some || loaded.left_out.empty()) return;
  std::vector<io::Problem> problems;
  for (const sim::LeftOut& specimen : loaded.left_out)
    problems.push_back({file.string(), specimen.what + ": " + specimen.why, ""});
  problems.push_back({file.string(), "no specimen is left to fit", ""});
  throw io::InputError(std::move(problems));
}

}  // namespace

std::vector<io::Problem> scene_problems(const calib::Study& study,
                                        const std::filesystem::path& file) {
  std::vector<io::Problem> problems;
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    for (const sim::Scene::Problem& problem : calib::model_of(study, s).scene.problems()) {
      const std::string where = file.string() + ": model." + problem.key;
      if (std::ranges::find(problems, where, &io::Problem::where) == problems.end())
        problems.push_back(
            {where,
             fmt::format("{} (as specimen {} is tested)", problem.what, study.specimens[s].id),
             problem.hint});
    }
  return problems;
}

std::vector<std::string> LoadedStudy::all_notes() const {
  std::vector<std::string> all = notes;
  all.insert(all.end(), file_notes.begin(), file_notes.end());
  return all;
}

LoadedStudy load_study(const std::filesystem::path& file, const io::Overrides& overrides,
                       std::vector<std::string>* known) {
  std::vector<io::Problem> problems;
  io::StudyFile read = io::read_study(file, overrides, problems);
  const bool sound = problems.empty();
  // One for each specimen, in the study's order; only one task writes to each.
  std::vector<Outcome> outcomes(read.specimens.size());
  tbb::parallel_for(std::size_t{0}, outcomes.size(), [&](std::size_t i) {
    outcomes[i] = load_specimen(read.study.specimens[i], read.specimens[i], read, sound);
  });

  for (const Outcome& outcome : outcomes) collect(problems, outcome.problems);

  LoadedStudy loaded;
  loaded.study = std::move(read.study);
  loaded.study.specimens.clear();
  loaded.inputs = std::move(read.inputs);
  loaded.notes = std::move(read.warnings);
  doubt_specimens(read.specimens, loaded);
  std::vector<OwnWords> own(outcomes.size());
  std::ranges::transform(outcomes, own.begin(), &Outcome::own);
  doubt_tests(read.specimens, own, loaded);
  // Before anything is thrown: `check` also shows the notes of a study that is refused.
  if (known != nullptr) *known = notes_of(loaded, outcomes);
  if (!problems.empty()) throw io::InputError(std::move(problems));
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    take_specimen(read.specimens[i], std::move(outcomes[i]), loaded);
  require_specimens(loaded, file);
  // Scenes need the rates of the tests, which are known only now.
  if (problems = scene_problems(loaded.study, file); !problems.empty())
    throw io::InputError(std::move(problems));
  doubt_model(read.rate_is_given, loaded);
  return loaded;
}

}  // namespace havers::cli
