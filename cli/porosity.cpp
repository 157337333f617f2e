// havers porosity: porosity of sections, measured on their images.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "calib/porosity/scatter_map.hpp"
#include "cli/command.hpp"
#include "cli/output_folder.hpp"
#include "cli/provenance.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"

namespace havers::cli {
namespace {

constexpr const char* examples =
    "  havers porosity section.png --pixel-size-um 5\n"
    "  havers porosity A1_*.png --pixel-size-um 5 -o runs/sections   # with overlays and a page\n";

struct Arguments {
  std::vector<std::filesystem::path> images;
  std::filesystem::path folder, mask;
  std::optional<double> pixel_size_um;
  double fibre_length_um = 100.0, fibre_height_um = 10.0;
};

struct Section {
  io::SectionMeasurement measured;
  double scatter = 0.0;  ///< d that this section alone would give. [-]
  std::vector<io::Problem> problems;
};

io::SectionOptions options_of(const Arguments& arguments) {
  io::SectionOptions options;
  if (arguments.pixel_size_um) options.pixel_size = 1e-6 * *arguments.pixel_size_um;
  if (!arguments.mask.empty()) options.mask = arguments.mask;
  options.window_length = 1e-6 * arguments.fibre_length_um;
  options.window_height = 1e-6 * arguments.fibre_height_um;
  return options;
}

std::vector<Section> measure_all(const Arguments& arguments) {
  const io::SectionOptions options = options_of(arguments);
  std::vector<Section> sections(arguments.images.size());
  tbb::parallel_for(std::size_t{0}, sections.size(), [&](std::size_t i) {
    try {
      sections[i].measured = io::measure_section(arguments.images[i], options);
      sections[i].scatter =
          calib::scatter_of(calib::pool_sections({sections[i].measured.porosity}), {});
    } catch (const io::InputError& error) {
      sections[i].problems = error.problems();
    }
  });
  std::vector<io::Problem> problems;
  for (const Section& section : sections)
    problems.insert(problems.end(), section.problems.begin(), section.problems.end());
  if (!problems.empty()) throw io::InputError(std::move(problems));
  return sections;
}

void print_table(const std::vector<Section>& sections) {
  fmt::print("porosity [%]   +-    pores   window SD   scatter  section\n");
  for (const Section& section : sections) {
    const calib::SectionPorosity& found = section.measured.porosity;
    fmt::print("{:>12.3f}{:>7.3f}{:>7}{:>12.4f}{:>10.3f}  {}\n", 100.0 * found.porosity,
               100.0 * found.porosity_standard_error, found.pore_count, found.window_sd,
               section.scatter, found.file);
    for (const std::string& warning : found.warnings) fmt::print("  note: {}\n", warning);
  }
}

nlohmann::json json_of(const std::vector<Section>& sections) {
  nlohmann::json all = nlohmann::json::array();
  for (const Section& section : sections)
    all.push_back(io::porosity_json(section.measured.porosity, section.scatter));
  if (all.size() == 1) return all.front();
  return {{"sections", all}};
}

void write_page(const Arguments& arguments, const std::vector<Section>& sections,
                const CommonOptions& common, const Stopwatch& watch) {
  OutputFolder output(arguments.folder, common.force);
  reports::PorosityReport page;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const auto& overlay = sections[i].measured.overlay_png;
    io::write_file(output.stage(arguments.images[i].stem().string() + "_overlay.png"),
                   {overlay.begin(), overlay.end()});
    page.sections.push_back(sections[i].measured.porosity);
    page.overlays.push_back(overlay);
    page.scatter.push_back(sections[i].scatter);
  }
  page.provenance = page_facts(provenance_of(common, arguments.images, watch));
  io::write_file(output.stage("porosity.json"), json_of(sections).dump(2) + "\n");
  if (reports::available())
    io::write_file(output.stage("report.html"), reports::porosity_page(page));
  output.publish();
}

int run_porosity(const Arguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  const std::vector<Section> sections = measure_all(arguments);
  if (!arguments.folder.empty()) write_page(arguments, sections, common, watch);
  if (common.json) {
    fmt::print("{}\n", json_of(sections).dump(2));
    return done;
  }
  print_table(sections);
  if (!arguments.folder.empty())
    fmt::print(
        "{}\n",
        (arguments.folder / (reports::available() ? "report.html" : "porosity.json")).string());
  return done;
}

}  // namespace

Command porosity_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "porosity",
                                 "porosity of sections, measured on their images", examples);
  const auto arguments = std::make_shared<Arguments>();
  parser->add_option("IMAGE", arguments->images, "PNG, TIFF, JPEG or BMP")->required();
  parser->add_option("-o,--output", arguments->folder, "folder for overlays and a page")
      ->type_name("DIR");
  parser->add_option("--pixel-size-um", arguments->pixel_size_um, "size of a pixel")
      ->check(CLI::PositiveNumber);
  parser->add_option("--mask", arguments->mask, "image that is white where the bone is")
      ->type_name("FILE");
  parser
      ->add_option("--fibre-length-um", arguments->fibre_length_um,
                   "of the window whose porosity spreads")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parser->add_option("--fibre-height-um", arguments->fibre_height_um, "of that window")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  return {parser, [arguments, &common] { return run_porosity(*arguments, common); }};
}

}  // namespace havers::cli
