// Reads a study table by table. Every function notes what is wrong and goes on with the rest, so
// that all that is wrong is said at once.
#include "io/config/read_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "calib/study/parameter.hpp"
#include "io/config/file_kind.hpp"
#include "io/config/nearest.hpp"
#include "io/config/scene_tables.hpp"
#include "io/config/study_doubts.hpp"
#include "io/config/study_keys.hpp"
#include "io/sweep/sweep_files.hpp"

namespace havers::io {
namespace {

void require_positive(TableReader& table, std::string_view key, const std::optional<double>& value,
                      KeyUnit unit = {}) {
  if (value) table.require(*value > 0.0, key, from_si(*value, unit), "above 0");
}

void require_not_negative(TableReader& table, std::string_view key, double value) {
  table.require(value >= 0.0, key, value, "0 or more");
}

// The id names files of the result, with endings.
constexpr std::size_t longest_id = 200;  // bytes; file systems take 255

bool no_part_of_an_id(char c) {
  return c == '/' || c == '\\' || c == '"' || (c >= '\0' && c < ' ');
}

void check_id(TableReader& table, const std::string& id, std::set<std::string>& ids) {
  if (table.has("id") && !table.is_text("id")) return;  // that was said
  if (id.empty())
    table.complain("id", table.has("id") ? "is empty" : "is missing", "name the specimen");
  else if (std::ranges::any_of(id, no_part_of_an_id) || id.front() == '.' || id.size() > longest_id)
    table.complain("id", fmt::format("is \"{}\", must be usable as a file's name", id));
  else if (!ids.insert(id).second)
    table.complain("id", fmt::format("is \"{}\", as that of an earlier specimen", id));
}

// Files of one id may not be those of another: io/results and cli add to ids.
void check_file_names(TableReader& table, const std::string& id, const std::set<std::string>& ids) {
  for (const std::string_view ending : {"_measured", "_clocks"}) {
    if (!id.ends_with(ending)) continue;
    const std::string other = id.substr(0, id.size() - ending.size());
    if (ids.contains(other))
      table.complain("id", fmt::format(R"(is "{}", which names files of "{}")", id, other),
                     "give one of them another id");
  }
}

void check_specimen(TableReader& table, const SpecimenFiles& specimen) {
  if (!table.has("test")) table.complain("test", "is missing", "the testing machine's file");
  require_positive(table, "width_mm", specimen.width, millimetre);
  require_positive(table, "thickness_mm", specimen.thickness, millimetre);
  require_positive(table, "gauge_length_mm", specimen.gauge_length, millimetre);
  require_positive(table, "pixel_size_um", specimen.pixel_size, micrometre);
  constexpr double right_angle = std::numbers::pi / 2.0;
  if (specimen.orientation)
    table.require(*specimen.orientation > -right_angle && *specimen.orientation <= right_angle,
                  "orientation_deg", from_si(*specimen.orientation, degree),
                  "above -90 and at most 90");
  if (specimen.porosity)
    table.require(*specimen.porosity >= 0.0 && *specimen.porosity < 1.0, "porosity",
                  *specimen.porosity, "at least 0 and below 1");
}

void check_files(TableReader& table, const SpecimenFiles& specimen) {
  if (table.has("test")) table.require_file("test", specimen.test);
  if (specimen.gauge) table.require_file("gauge", *specimen.gauge);
  if (specimen.mask) table.require_file("mask", *specimen.mask);
  for (const std::filesystem::path& section : specimen.sections)
    table.require_file("sections", section);
}

std::vector<SpecimenFiles> read_specimens(TableReader& top, Files files) {
  std::vector<SpecimenFiles> specimens;
  std::set<std::string> ids;
  if (!top.has("specimen"))
    top.complain("specimen", "is missing", "write one [[specimen]] for each test");
  std::vector<TableReader> tables = top.tables("specimen");
  for (TableReader& table : tables) {
    SpecimenFiles& specimen = specimens.emplace_back();
    keys(table, specimen);
    TableReader columns = table.table("columns"), gauge_columns = table.table("gauge_columns");
    keys(columns, specimen.columns);
    keys(gauge_columns, specimen.gauge_columns);
    if (specimen.orientation) *specimen.orientation += 0.0;  // -0 is 0, and no other group
    check_id(table, specimen.id, ids);
    check_specimen(table, specimen);
    if (table.has("orientation_deg") && !specimen.orientation)
      specimen.orientation = 0.0;  // what is wrong with it was said: it is not missing too
    if (files == Files::must_exist) check_files(table, specimen);  // else synthesize writes them
  }
  if (!tables.empty() && std::ranges::count(specimens, calib::Use::fit, &SpecimenFiles::use) == 0)
    top.complain("specimen", "none has use = \"fit\"", "a fit needs at least one that it may use");
  for (std::size_t i = 0; i < tables.size(); ++i) check_file_names(tables[i], specimens[i].id, ids);
  return specimens;
}

void read_porosity(TableReader table, calib::PorosityOptions& porosity) {
  keys(table, porosity);
  require_not_negative(table, "strength_exponent", porosity.strength_exponent);
  require_not_negative(table, "modulus_exponent", porosity.modulus_exponent);
  table.require(porosity.linear_offset >= 0.0 && porosity.linear_offset < 2.0, "linear_offset",
                porosity.linear_offset, "at least 0 and below 2");
  require_not_negative(table, "linear_slope", porosity.linear_slope);
}

// Only known names are kept, so that what is judged later complains of something else.
void read_parameters(TableReader& calibrate, calib::CalibrateOptions& options) {
  if (calibrate.is_text("parameters")) {
    std::string text;
    calibrate.key("parameters", text);
    options.automatic = text == "auto";
    if (!options.automatic)
      calibrate.complain("parameters", fmt::format("is \"{}\", must be a list of names", text),
                         "or \"auto\": what the specimens inform");
    return;
  }
  std::vector<std::string> names;
  if (!calibrate.key("parameters", names)) return;
  std::set<std::string, std::less<>> known;
  for (const calib::ParameterInfo& info : calib::all_parameters()) known.emplace(info.name);

  bool all_known = true;
  for (const std::string& name : names) {
    if (known.contains(name)) continue;
    calibrate.complain("parameters", fmt::format("names \"{}\", which cannot be calibrated", name),
                       nearest_or_all(name, known));
    all_known = false;
  }
  if (all_known) options.parameters = names;
}

// A bound must be in order with itself, and the model must be possible at either end.
void check_bounds(TableReader& bounds, std::string_view name, std::pair<double, double> value,
                  const sim::Scene& model) {
  calib::CalibrateOptions alone;
  alone.bounds.emplace(name, value);
  const std::vector<calib::CalibrateOptions::Problem> problems = alone.problems();
  for (const auto& problem : problems) bounds.complain(name, problem.what);
  if (!problems.empty() || !model.problems().empty()) return;  // said already
  for (const double end : {value.first, value.second}) {
    sim::Scene scene = model;
    calib::apply(scene, name, end);  // the laws of porosity have no problems of their own
    for (const sim::Scene::Problem& problem : scene.problems())
      bounds.complain(name, fmt::format("at {:g}: {} {}", end, problem.key, problem.what));
  }
}

void read_calibrate(TableReader calibrate, const sim::Scene& model,
                    calib::CalibrateOptions& options) {
  read_parameters(calibrate, options);
  TableReader bounds = calibrate.table("bounds");
  TableReader level = calibrate.table("level");
  TableReader settings = calibrate.table("options");
  keys(settings, options);
  for (const auto& problem : options.problems()) calibrate.complain(problem.key, problem.what);

  for (const calib::ParameterInfo& info : calib::all_parameters()) {
    std::pair<double, double> range;
    if (bounds.key(info.name, range)) {
      check_bounds(bounds, info.name, range, model);
      options.bounds.emplace(info.name, range);
    }
    calib::Level shared_over{};
    if (level.key(info.name, shared_over)) options.level.emplace(info.name, shared_over);
  }
}

// What a fit looks for would take the place of what a specimen's sections tell.
void check_scatter(TableReader calibrate, const StudyFile& read) {
  const auto& names = read.study.calibrate.parameters;
  const auto measured = std::ranges::find_if(read.specimens, [&](const SpecimenFiles& specimen) {
    return calib::tells_scatter(specimen, read.study.porosity);
  });
  if (std::ranges::find(names, "scatter") == names.end() || measured == read.specimens.end())
    return;
  calibrate.complain(
      "parameters",
      fmt::format("names \"scatter\", which specimen {} has from its {}", measured->id,
                  measured->sections.empty() ? "porosity" : "sections"),
      "set porosity.to_scatter = \"none\" to fit it, or leave it out of the parameters");
}

void read_laws_file(TableReader calibrate, std::vector<calib::SweepLaw>& laws) {
  std::filesystem::path file;
  if (!calibrate.key("laws", file) || !calibrate.require_file("laws", file)) return;
  try {
    laws = read_laws(file);
  } catch (const InputError& error) {
    calibrate.complain(error.problems());
  }
}

void read_synthesize(TableReader table, SynthesizeOptions& options) {
  keys(table, options);
  require_not_negative(table, "force_noise_N", options.laboratory.force_noise);
  require_not_negative(table, "strain_noise", options.laboratory.strain_noise);
  require_not_negative(table, "preload_N", options.laboratory.preload);
  require_not_negative(table, "toe_strain", options.laboratory.toe_strain);
  require_not_negative(table, "modulus_cv", options.modulus_cv);
  require_positive(table, "sampling_s", options.laboratory.sampling);
  require_positive(table, "crosshead_mm_per_min", options.laboratory.crosshead_rate,
                   millimetre_per_minute);
  require_positive(table, "pore_radius_um", options.pore_radius, micrometre);
  table.require(options.section_pixels >= 16 && options.section_pixels <= 4096, "section_pixels",
                options.section_pixels, "from 16 to 4096");
}

void read_sections(TableReader table, SectionOptions& options) {
  keys(table, options);
  require_not_negative(table, "rim_um", from_si(options.rim, micrometre));
  require_not_negative(table, "crack_slenderness", options.crack_slenderness);
}

calib::Specimen without_tests(const SpecimenFiles& files) {
  calib::Specimen specimen;
  specimen.id = files.id;
  specimen.use = files.use;
  specimen.broke = files.broke.value_or(true);  // until its record is read
  specimen.orientation = files.orientation.value_or(0.0);
  specimen.porosity = files.porosity;
  return specimen;
}

StudyFile read_tables(ConfigFile& config, const std::filesystem::path& file, Files files) {
  TableReader top = config.top();
  require_kind(FileKind::study, top, file);
  StudyFile read;
  top.table("study").key("name", read.study.name);
  read.specimens = read_specimens(top, files);
  for (const SpecimenFiles& specimen : read.specimens)
    read.study.specimens.push_back(without_tests(specimen));

  TableReader model = top.table("model");
  read_scene_tables(model, read.study.model);
  read.rate_is_given = model.table("loading").has("strain_rate_per_s");
  if (TableReader joints = model.table("joints"); joints.has("thresholds_file"))
    joints.complain("thresholds_file",
                    "is of one assembly; a study draws thresholds for each specimen",
                    "leave it out; a scene for havers simulate may name it");

  read_porosity(top.table("porosity"), read.study.porosity);
  read_calibrate(top.table("calibrate"), read.study.model, read.study.calibrate);
  check_scatter(top.table("calibrate"), read);
  read_laws_file(top.table("calibrate"), read.study.laws);
  read_synthesize(top.table("synthesize"), read.synthesize);
  read_reduction(top.table("reduction"), read.reduction);
  read_sections(top.table("sections"), read.sections);
  read.warnings = study_doubts(top, read);
  read.inputs = config.inputs();
  read.names = config.names();
  return read;
}

}  // namespace

void read_reduction(TableReader table, calib::ReductionOptions& options) {
  keys(table, options);
  // Of two that do not rise the one that the user gave is wrong.
  const bool rises = options.window_low < options.window_high;
  const bool high_is_given = table.has("window_high");
  table.require(options.window_low >= 0.0 && (rises || high_is_given), "window_low",
                options.window_low, "0 or more and below window_high");
  table.require(options.window_high <= 1.0 && (rises || !high_is_given), "window_high",
                options.window_high, "above window_low and at most 1");
  table.require(options.break_part > 0.0 && options.break_part < 1.0, "break_part",
                options.break_part, "between 0 and 1");
  require_not_negative(table, "straightness", options.straightness);
  require_not_negative(table, "machine_compliance_mm_per_kN",
                       from_si(options.machine_compliance, millimetre_per_kilonewton));
  require_positive(table, "largest_modulus_error", options.largest_modulus_error);
  require_positive(table, "largest_noise", options.largest_noise);
}

StudyFile read_study(const std::filesystem::path& file, const Overrides& overrides, Files files) {
  ConfigFile config(file, overrides);
  StudyFile read = read_tables(config, file, files);
  config.finish();
  return read;
}

StudyFile read_study(const std::filesystem::path& file, const Overrides& overrides,
                     std::vector<Problem>& problems) {
  ConfigFile config(file, overrides);
  StudyFile read = read_tables(config, file, Files::must_exist);
  problems = config.problems();
  return read;
}

}  // namespace havers::io
