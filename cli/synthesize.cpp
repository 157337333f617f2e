// havers synthesize: a study's files made by the model, with noise and a known truth.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "calib/experiment/join_logger.hpp"
#include "calib/experiment/measured_test.hpp"
#include "calib/fit/scenes.hpp"
#include "calib/study/parameter.hpp"
#include "calib/synthetic/laboratory_record.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/load_study.hpp"
#include "cli/output_folder.hpp"
#include "io/config/key_unit.hpp"
#include "io/config/read_study.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"
#include "io/results/result_files.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* synthesize_examples =
    "  havers synthesize data_samples/bone_bars/study.toml -o runs/made --seed 7\n"
    "  havers synthesize data_samples/bone_bars/study.toml -o runs/stiff "
    "--set model.material.young_GPa=15\n"
    "      # sets the truth; the copy of study.toml in runs/stiff keeps its starting point\n";

struct SynthesizeArguments {
  fs::path study, folder;
};

/// A specimen as made: what a fit must find again.
struct Made {
  calib::Specimen specimen;
  sim::Scene scene;
  sim::Simulation simulation;
  std::optional<double> gauge_clock;  ///< At the test's first row, of a gauge of its own. [s]
  std::vector<std::string> problems;  ///< That the test has for a fit.
};

// The sizes of the study; for those that it lacks the defaults of calib::Bar.
calib::Bar bar_of(const io::SpecimenFiles& files) {
  calib::Bar bar;
  bar.width = files.width.value_or(bar.width);
  bar.thickness = files.thickness.value_or(bar.thickness);
  bar.gauge_length = files.gauge_length.value_or(bar.gauge_length);
  return bar;
}

// Every file goes to the same place beside the copy of the study that it has beside the study.
fs::path place(const fs::path& study, const fs::path& file) {
  const fs::path folder = fs::absolute(study).lexically_normal().parent_path();
  return fs::absolute(file).lexically_normal().lexically_relative(folder);
}

// What the copy of the study would name in vain.
void refuse_what_is_not_made(const std::string& where, const io::SpecimenFiles& specimen,
                             std::vector<io::Problem>& problems) {
  const auto refuse = [&](bool named, const std::string& key) {
    if (named) problems.push_back({where, "has " + key + ", which is not made", "leave it out"});
  };
  // The tests that are made are exports of one machine with one specimen each; images have no mask.
  refuse(specimen.mask.has_value(), "a mask");
  refuse(!specimen.columns.specimen.empty() || specimen.columns.specimen_number,
         "specimen_in_file");
  for (const auto& [hints, key] : {std::pair(&specimen.columns, "columns"),
                                   std::pair(&specimen.gauge_columns, "gauge_columns")})
    refuse(!hints->columns.empty() || !hints->units.empty(), key);
}

// All files must lie in the study's folder or below it, and none may be named twice. Otherwise the
// copy would write outside its own folder or overwrite its own files.
std::vector<io::Problem> problems_of(const fs::path& study, const io::StudyFile& file) {
  std::vector<io::Problem> problems;
  for (const fs::path& name : file.names)  // The copy has it too: it would find the original.
    if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end())
      problems.push_back(
          {study.string(), fmt::format("names {}, which may lie outside its folder", name.string()),
           "name files in that folder, relative to it, to have them made or copied"});
  std::set<fs::path> to_be_made{"study.toml", "truth.json"};
  for (const fs::path& input : file.inputs)  // these are copied
    to_be_made.insert(place(study, input));
  for (const io::SpecimenFiles& specimen : file.specimens) {
    std::vector<fs::path> files = specimen.sections;
    files.push_back(specimen.test);
    if (specimen.gauge) files.push_back(*specimen.gauge);
    for (const fs::path& path : files)
      if (!to_be_made.insert(place(study, path)).second)
        problems.push_back({path.string(), "would be made twice",
                            "give each specimen files of its own to have them made"});
    const std::string where = study.string() + ": specimen " + specimen.id;
    refuse_what_is_not_made(where, specimen, problems);
    if (!specimen.sections.empty() && !specimen.porosity)
      problems.push_back(
          {where, "has sections to draw but no porosity", "add porosity = 0.05, say"});
  }
  return problems;
}

constexpr double most_lacking = 0.02;  // of the porosity aimed at; pores come whole

// Draws the sections; what was drawn, not what was aimed at, is the truth.
std::vector<calib::SectionPorosity> draw_sections(const fs::path& study, const OutputFolder& output,
                                                  const io::StudyFile& file, std::size_t s,
                                                  std::uint64_t seed) {
  const io::SpecimenFiles& specimen = file.specimens[s];
  const sim::AssemblyOptions& fibres = file.study.model.assembly;
  std::vector<calib::SectionPorosity> drawn;
  io::SectionDrawing drawing{.pixels = file.synthesize.section_pixels,
                             .porosity = specimen.porosity.value_or(0.0),
                             .pore_radius = file.synthesize.pore_radius};
  drawing.pixel_size = specimen.pixel_size.value_or(drawing.pixel_size);
  io::SectionOptions window;
  window.pixel_size = drawing.pixel_size;
  window.window_length = fibres.fibre_length;
  window.window_height = fibres.fibre_height;
  for (std::size_t i = 0; i < specimen.sections.size(); ++i) {
    drawing.seed = calib::specimen_seed(seed, i);
    const fs::path image = output.stage(place(study, specimen.sections[i]));
    drawn.push_back(io::draw_section(image, drawing, window));
    if (drawing.porosity - drawn.back().porosity > most_lacking)
      throw io::InputError(
          study.string() + ": specimen " + specimen.id,
          fmt::format("has porosity {:g}, of which a section holds {:.2f}: pores lie apart",
                      drawing.porosity, drawn.back().porosity),
          "lower it, or change pore_radius_um or section_pixels");
  }
  return drawn;
}

// The study at the rates that its tests will have.
calib::Study as_tested(const io::StudyFile& file) {
  calib::Study study = file.study;
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    study.specimens[s].test.strain_rate =
        calib::strain_rate(bar_of(file.specimens[s]), file.synthesize.laboratory);
  return study;
}

// One specimen with its sections, scene and test. Specimens share no file, so that they can be made
// in parallel.
Made make_specimen(const fs::path& study, const OutputFolder& output, const io::StudyFile& file,
                   std::size_t s) {
  const std::uint64_t seed = calib::specimen_seed(file.study.calibrate.seed, s);
  const calib::Bar bar = bar_of(file.specimens[s]);
  const calib::Laboratory& laboratory = file.synthesize.laboratory;

  calib::Study one = file.study;
  calib::Specimen& specimen = one.specimens[s];
  // Sections come first: the scatter and the modulus of the scene depend on them.
  specimen.sections = draw_sections(study, output, file, s, seed);
  specimen.test.strain_rate = calib::strain_rate(bar, laboratory);
  calib::SpecimenModel model = calib::model_of(one, s);
  model.scene.material.young *=
      model.modulus_factor * calib::modulus_variation(seed, file.synthesize.modulus_cv);
  model.scene.joints.seed = seed;

  Made made{.specimen = specimen, .scene = model.scene};
  made.simulation = sim::simulate(made.scene, {}, interrupted);
  if (!calib::is_test(made.simulation)) return made;  // nothing to record
  calib::RawTest machine = calib::record_test(made.simulation, bar, laboratory, seed);
  machine.specimen_id = specimen.id;
  calib::JoinedTest read{.test = machine};  // as `fit` does
  if (const auto& gauge = file.specimens[s].gauge) {
    calib::RawTest logger = calib::record_logger(made.simulation, bar, laboratory, seed);
    logger.specimen_id = specimen.id;
    made.gauge_clock = calib::logger_at_first_row(made.simulation, bar, laboratory);
    machine.strain.clear();
    io::write_bluehill(output.stage(place(study, *gauge)), logger);
    read = calib::join_logger(machine, logger, file.reduction);
  }
  io::write_bluehill(output.stage(place(study, file.specimens[s].test)), machine);
  // Why `fit` could not use the test.
  made.problems = read.problems.empty() ? calib::reduce_test(read.test, file.reduction).problems
                                        : std::move(read.problems);
  return made;
}

std::vector<Made> make_all(const fs::path& study, const OutputFolder& output,
                           const io::StudyFile& file) {
  std::vector<Made> made(file.specimens.size());
  tbb::parallel_for(std::size_t{0}, made.size(),
                    [&](std::size_t s) { made[s] = make_specimen(study, output, file, s); });
  return made;
}

// What a fit should find: the parameters of the study, and the values of each specimen.
nlohmann::json truth_of(const io::StudyFile& file, const std::vector<Made>& made) {
  nlohmann::json parameters;
  const bool one_scatter = file.study.porosity.to_scatter == calib::ToScatter::none;
  for (const calib::ParameterInfo& parameter : calib::all_parameters())
    if (parameter.automatic &&  // otherwise each specimen has its own scatter
        (parameter.name != "scatter" || one_scatter))
      parameters[std::string(parameter.name)] = calib::value_of(file.study.model, parameter.name);
  nlohmann::json specimens = nlohmann::json::array();
  for (const Made& one : made) {
    nlohmann::json specimen{{"id", one.specimen.id},
                            {"orientation_deg", io::from_si(one.specimen.orientation, io::degree)},
                            {"scatter", one.scene.joints.scatter},
                            {"missing_joints", one.scene.joints.missing},
                            {"seed", one.scene.joints.seed},
                            {"young_GPa", 1e-9 * one.scene.material.young},
                            {"status", sim::to_string(one.simulation.status)},
                            {"modulus_Pa", one.simulation.modulus},
                            {"strength_Pa", one.simulation.strength},
                            {"failure_strain", one.simulation.failure_strain}};
    if (!one.specimen.sections.empty()) {
      const calib::SpecimenPorosity porosity = calib::pool_sections(one.specimen.sections);
      specimen["porosity"] = porosity.porosity;
      specimen["window_sd"] = porosity.window_sd;
    }
    if (one.gauge_clock) specimen["gauge_clock_at_first_row_s"] = *one.gauge_clock;
    specimens.push_back(specimen);
  }
  return {{"study", file.study.name},
          {"seed", file.study.calibrate.seed},
          {"parameters", parameters},
          {"specimens", specimens}};
}

// If a setting can be changed to help, it is named.
std::string why_no_test(const Made& made) {
  if (made.simulation.status == sim::SimulationStatus::strain_limit)
    return fmt::format("does not break within model.loading.max_strain = {:g} %: raise it",
                       100.0 * made.scene.loading.max_strain);
  return made.simulation.trusted() ? sim::explain(made.simulation.status)
                                   : made.simulation.why_not_trusted();
}

// Whether every specimen stands for a test; says on stderr which does not.
bool all_are_tests(const std::vector<Made>& made) {
  bool all = true;
  for (const Made& one : made) {
    if (calib::is_test(one.simulation)) continue;
    say(fmt::format("specimen {}: {}", one.specimen.id, why_no_test(one)));
    all = false;
  }
  return all;
}

void print_summary(const std::vector<Made>& made) {
  fmt::print("specimen    angle [deg]   scatter   E [GPa]   strength [MPa]   failure strain [%]\n");
  for (const Made& one : made)
    fmt::print("{:<12}{:>11.1f}{:>10.3f}{:>10.3f}{:>17.2f}{:>21.4f}\n", one.specimen.id,
               one.specimen.orientation / calib::degree, one.scene.joints.scatter,
               1e-9 * one.simulation.modulus, 1e-6 * one.simulation.strength,
               100.0 * one.simulation.failure_strain);
}

int run_synthesize(const SynthesizeArguments& arguments, const CommonOptions& common) {
  io::StudyFile file = io::read_study(arguments.study, common.set, io::Files::will_be_written);
  if (common.seed) file.study.calibrate.seed = *common.seed;
  std::vector<io::Problem> problems = problems_of(arguments.study, file);
  // Scenes can be checked only if the study itself has no problems.
  if (problems.empty()) problems = scene_problems(as_tested(file), arguments.study);
  if (!problems.empty()) throw io::InputError(std::move(problems));
  catch_interrupts();
  OutputFolder output(arguments.folder, common.force, file.inputs);

  for (const fs::path& input : file.inputs)  // as they are now
    fs::copy_file(input, output.stage(input == arguments.study ? "study.toml"
                                                               : place(arguments.study, input)));

  const std::vector<Made> made = make_all(arguments.study, output, file);
  // A copy of the study without one of its tests would be of no use.
  if (!all_are_tests(made))
    return without_result(common, interrupted() ? "cancelled" : "failed", "nothing was written");
  for (const Made& one : made)
    for (const std::string& problem : one.problems)
      note(common,
           fmt::format("note: specimen {}: no test for a fit: {}", one.specimen.id, problem));
  const nlohmann::json truth = truth_of(file, made);
  output.write("truth.json", io::json_text(truth));
  answer(common, &output, truth, "study.toml", [&] { print_summary(made); });
  return done;
}

}  // namespace

Command synthesize_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser =
      add_command(app, common, "synthesize",
                  "a study's files made by the model, with a known truth", synthesize_examples);
  const auto arguments = std::make_shared<SynthesizeArguments>();
  parser->add_option("STUDY", arguments->study, "study file (TOML)")->required();
  add_output(*parser, arguments->folder, "folder for the study")->required();
  return {parser, [arguments, &common] { return run_synthesize(*arguments, common); }};
}

}  // namespace havers::cli
