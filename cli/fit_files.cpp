#include "cli/fit_files.hpp"

#include <fmt/core.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/provenance.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

fs::path overlay_file(const std::string& id, std::size_t section) {
  return fmt::format("overlays/{}_{}.png", id, section + 1);
}

std::vector<std::uint8_t> read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

void write_fit(const OutputFolder& output, const LoadedStudy& loaded,
               const calib::CalibrationResult& result, const io::Provenance& provenance) {
  for (const calib::SpecimenResult& specimen : result.specimens) {
    io::write_band(output.stage(io::band_file(specimen.id)), specimen.band);
    io::write_measured(output.stage(io::measured_file(specimen.id)), specimen.measured);
  }
  for (const auto& [id, images] : loaded.overlays)
    for (std::size_t i = 0; i < images.size(); ++i)
      io::write_file(output.stage(overlay_file(id, i)), {images[i].begin(), images[i].end()});
  io::write_file(output.stage("scene.toml"), io::scene_toml(result.scene));
  if (reports::available())
    io::write_file(output.stage("report.html"),
                   reports::fit_page({loaded.study, result, loaded.overlays, page_facts(provenance),
                                      provenance.wall_seconds}));
  io::write_file(output.stage("result.json"),
                 io::calibration_json(loaded.study, result, provenance).dump(2) + "\n");
}

reports::FitReport FinishedFit::report() const {
  return {fit.study, fit.result, overlays, page_facts(fit.provenance), fit.provenance.wall_seconds};
}

FinishedFit read_fit(const fs::path& folder) {
  FinishedFit finished{.fit = io::read_fit_folder(folder), .overlays = {}};
  for (const calib::SpecimenResult& specimen : finished.fit.result.specimens)
    for (std::size_t i = 0; fs::exists(folder / overlay_file(specimen.id, i)); ++i)
      finished.overlays[specimen.id].push_back(read_bytes(folder / overlay_file(specimen.id, i)));
  return finished;
}

}  // namespace havers::cli
