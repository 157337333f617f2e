// `fit` writes overlays and figures of tests, `report` reads them back: their names are made only
// here.
#include "cli/fit_files.hpp"

#include <fmt/core.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cli/kept_run.hpp"
#include "io/input_error.hpp"
#include "io/read_text.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

// Names count sections from 1, in the order in which they were measured.
fs::path overlay_file(const std::string& id, std::size_t section) {
  return fmt::format("overlays/{}_{}.png", id, section + 1);
}

std::vector<std::uint8_t> read_bytes(const fs::path& file) {
  const std::string bytes = io::read_text(file, "");
  return {bytes.begin(), bytes.end()};
}

// Figure 0 shows the test, figure 1 the clocks of machine and logger.
fs::path test_file(const std::string& id, std::size_t figure) {
  return fmt::format("tests/{}{}.svg", id, figure == 0 ? "" : "_clocks");
}

using TestFigures = std::map<std::string, std::vector<std::string>>;

TestFigures draw_tests(const LoadedStudy& loaded) {
  TestFigures figures;
  for (const calib::Specimen& specimen : loaded.study.specimens) {
    const TestRecord& record = loaded.records.at(specimen.id);
    // All figures are on one page: the ids inside them must differ.
    const std::string id = fmt::format("r{}", figures.size());
    std::vector<std::string>& drawn = figures[specimen.id];
    drawn.push_back(reports::test_svg({specimen.id, record.raw, specimen.test}, id));
    if (record.clocks) drawn.push_back(reports::clocks_svg(*record.clocks, id + "c"));
  }
  return figures;
}

void write_page(const OutputFolder& output, const LoadedStudy& loaded,
                const calib::CalibrationResult& result, const calib::Provenance& provenance) {
  const TestFigures tests = draw_tests(loaded);
  for (const auto& [id, figures] : tests)
    for (std::size_t i = 0; i < figures.size(); ++i) output.write(test_file(id, i), figures[i]);
  output.write("report.html",
               reports::fit_page({loaded.study, result, loaded.overlays, provenance, tests}));
}

// One scene is one specimen: which, a comment says.
std::string scene_file(const calib::CalibrationResult& result) {
  std::string whose = "# The model of the study: no specimen was fitted.\n";
  if (!result.scene_of.empty())
    whose = fmt::format(
        "# The fitted model as specimen {} has it, the first of those fitted: orientation, "
        "scatter\n"
        "# or missing joints, strain rate and, where porosity acts on it, modulus are that\n"
        "# specimen's, and the seed is that of its first replicate alone (replicates.csv has "
        "all).\n",
        nlohmann::json(result.scene_of).dump());  // no character of it ends the comment
  return whose + io::scene_toml(result.scene);
}

}  // namespace

nlohmann::json write_fit(const OutputFolder& output, const LoadedStudy& loaded,
                         const calib::CalibrationResult& result,
                         const calib::Provenance& provenance) {
  for (const calib::SpecimenResult& specimen : result.specimens) {
    io::write_band(output.stage(io::band_file(specimen.id)), specimen.band);
    io::write_measured(output.stage(io::measured_file(specimen.id)), specimen.measured);
  }
  io::write_terms(output.stage("terms.csv"), result.specimens);
  io::write_replicates(output.stage("replicates.csv"), result.specimens);
  for (const auto& [id, images] : loaded.overlays)
    for (std::size_t i = 0; i < images.size(); ++i)
      output.write(overlay_file(id, i), {images[i].begin(), images[i].end()});
  output.write("scene.toml", scene_file(result));
  if (reports::available()) write_page(output, loaded, result, provenance);
  nlohmann::json json = io::calibration_json(loaded.study, result, provenance);
  output.write("result.json", io::json_text(json));
  return json;
}

reports::FitReport FinishedFit::report() const {
  return {fit.study, fit.result, overlays, fit.provenance, tests};
}

fs::path folder_of_fit(const fs::path& result) {
  return fs::is_directory(result) ? result : fs::absolute(result).parent_path();
}

FinishedFit read_fit(const fs::path& result) {
  if (was_stopped(result))
    throw io::InputError(result.string(),
                         "has no result yet: its run was stopped, or goes on still",
                         "the same command as before goes on where it was stopped");
  FinishedFit finished{.fit = io::read_fit_folder(result), .overlays = {}, .tests = {}};
  const fs::path folder = folder_of_fit(result);
  for (const calib::SpecimenResult& specimen : finished.fit.result.specimens) {
    const std::string& id = specimen.id;
    for (std::size_t i = 0; fs::exists(folder / overlay_file(id, i)); ++i)
      finished.overlays[id].push_back(read_bytes(folder / overlay_file(id, i)));
    for (std::size_t i = 0; i < 2 && fs::exists(folder / test_file(id, i)); ++i)
      finished.tests[id].push_back(io::read_text(folder / test_file(id, i), ""));
  }
  return finished;
}

}  // namespace havers::cli
