#include "io/images/section_benchmark.hpp"

#include <algorithm>

#include "sim/stopwatch.hpp"

namespace havers::io {
namespace {

// As laboratories have them, the last one of the size of a whole section.
std::vector<SectionCase> hardships() {
  constexpr SectionDrawing plain{.pixels = 640, .noise = 0.02, .shading = 0.0};
  std::vector<SectionCase> all;
  const auto add = [&](const char* name) -> SectionDrawing& {
    return all.emplace_back(SectionCase{name, plain}).drawing;
  };
  add("none");
  add("noise").noise = 0.2;
  add("blur").blur = 1.5;
  add("cupping of 40 %").shading = 0.4;
  SectionDrawing& faint = add("low contrast under cupping");
  faint.contrast = faint.shading = 0.4;
  faint.noise = 0.1;
  SectionDrawing& stained = add("stain");
  stained.stain = true;
  stained.shading = 0.2;
  SectionDrawing& large = add("2048 × 2048 pixels");
  large.pixels = 2048;
  large.noise = 0.1;
  large.shading = 0.2;
  return all;
}

}  // namespace

std::vector<SectionCase> section_cases(int seeds) {
  std::vector<SectionCase> cases;
  std::uint64_t seed = 0;
  for (const SectionCase& hardship : hardships())
    for (const bool ring : {false, true})
      for (const double porosity : {0.0, 0.01, 0.05, 0.2})
        for (int repeat = 0; repeat < seeds; ++repeat) {
          SectionCase next = hardship;
          next.drawing.ring = ring;
          next.drawing.porosity = porosity;
          next.drawing.seed = ++seed;
          next.drawing.pore_radius = (seed % 2 == 0 ? 8.0 : 15.0) * next.drawing.pixel_size;
          cases.push_back(next);
        }
  return cases;
}

calib::PorosityTrial try_section(const SectionCase& section, const std::filesystem::path& image) {
  const SectionDrawing& drawing = section.drawing;
  calib::PorosityTrial trial{.hardship = section.hardship,
                             .ring = drawing.ring,
                             .pixels = static_cast<double>(drawing.pixels) * drawing.pixels};
  trial.truth = draw_section(image, drawing, {}).porosity;
  const auto common = measure_by_common_practice(image);
  std::copy(common.begin(), common.end(), trial.readings.begin());
  const sim::Stopwatch stopwatch;
  const calib::SectionPorosity ours =
      measure_sections(image, {.pixel_size = drawing.pixel_size, .pictures = false})
          .front()
          .porosity;
  trial.readings.back() = {ours.porosity, stopwatch.cpu_seconds()};
  trial.standard_error = ours.porosity_standard_error;
  return trial;
}

}  // namespace havers::io
