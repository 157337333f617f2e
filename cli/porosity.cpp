// havers porosity: porosity of sections, measured on their images.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "calib/porosity/scatter_map.hpp"
#include "cli/command.hpp"
#include "cli/number_check.hpp"
#include "cli/output_folder.hpp"
#include "cli/provenance.hpp"
#include "io/config/key_unit.hpp"
#include "io/config/words.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"
#include "reports/pages.hpp"

namespace havers::cli {
namespace {

constexpr const char* porosity_examples =
    "  havers porosity data_samples/bone_bars/A1_section.png --pixel-size-um 2\n"
    "  havers porosity data_samples/bone_bars/*.png --pixel-size-um 2 -o runs/sections   # and a "
    "page\n"
    "  havers porosity my/ct.tif --density 30=0 --density 140=1200      # grey level = kg/m³\n"
    "  havers porosity my/ct.tif --density 10,10,40,40=0 --density 10,80,40,40=800   # phantom\n";

struct PorosityArguments {
  std::vector<std::filesystem::path> images;
  std::filesystem::path folder, mask;
  std::optional<double> pixel_size_um;
  std::vector<std::string> density;
  double fibre_length_um = 100.0, fibre_height_um = 10.0, rim_um = 0.0;
  io::SectionOptions options;  // what needs no translation
};

struct Section {
  std::filesystem::path image;
  io::SectionMeasurement measured;
  double scatter = 0.0;  ///< d that this section alone would give. [-]
};

/// What one image gave: a section a page.
struct MeasuredFile {
  std::vector<io::SectionMeasurement> sections;
  std::vector<io::Problem> problems;
};

// What all images gave, those that could not be measured among them.
struct PorosityFindings {
  std::vector<Section> sections;
  std::vector<io::Problem> problems;
  std::vector<std::filesystem::path> read;
  nlohmann::json entries = nlohmann::json::array();  // an object a section, or an image's error
};

// GREY=DENSITY or X,Y,WIDTH,HEIGHT=DENSITY.
io::DensityReference reference_of(const std::string& text) {
  io::DensityReference known;
  std::istringstream in(text);
  const bool is_phantom = text.find(',') != std::string::npos;
  const auto comma = [](std::istream& from) -> std::istream& {
    if (char mark = 0; !(from >> mark) || mark != ',') from.setstate(std::ios::failbit);
    return from;
  };
  if (is_phantom)
    comma(comma(comma(in >> known.x) >> known.y) >> known.width) >> known.height;
  else
    in >> known.grey;
  char equals = 0;
  in >> equals >> known.density;
  // Nothing may follow.
  if (!in || !(in >> std::ws).eof() || equals != '=' || known.density < 0.0 ||
      (is_phantom && (known.width < 1 || known.height < 1)))
    throw io::InputError("--density " + text, "is not understood",
                         "write GREY=DENSITY or X,Y,WIDTH,HEIGHT=DENSITY, in kg/m³, 0 or more");
  return known;
}

// Converted to SI units; pictures are made only if there is a folder for them.
io::SectionOptions options_of(const PorosityArguments& arguments) {
  io::SectionOptions options = arguments.options;
  if (arguments.pixel_size_um)
    options.pixel_size = io::to_si(*arguments.pixel_size_um, io::micrometre);
  if (!arguments.mask.empty()) options.mask = arguments.mask;
  options.rim = io::to_si(arguments.rim_um, io::micrometre);
  options.window_length = io::to_si(arguments.fibre_length_um, io::micrometre);
  options.window_height = io::to_si(arguments.fibre_height_um, io::micrometre);
  for (const std::string& text : arguments.density) options.density.push_back(reference_of(text));
  options.pictures = !arguments.folder.empty();
  return options;
}

// Images that can be measured are shown even when others cannot.
PorosityFindings measure_all(const PorosityArguments& arguments) {
  const io::SectionOptions options = options_of(arguments);
  // One for each image, in their order, so that the result does not depend on threads.
  std::vector<MeasuredFile> outcomes(arguments.images.size());
  tbb::parallel_for(std::size_t{0}, outcomes.size(), [&](std::size_t i) {
    try {
      outcomes[i].sections = io::measure_sections(arguments.images[i], options);
    } catch (const io::InputError& error) {
      outcomes[i].problems = error.problems();
    }
  });
  PorosityFindings found;
  std::set<std::filesystem::path> seen;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::filesystem::path& image = arguments.images[i];
    if (const auto& problems = outcomes[i].problems; !problems.empty()) {
      found.entries.push_back(
          {{"file", image.string()}, {"error", io::InputError(problems).what()}});
      io::collect(found.problems, problems);
      continue;
    }
    found.read.push_back(image);
    // The same image may be listed by different paths.
    const bool fresh = seen.insert(std::filesystem::canonical(image)).second;
    for (io::SectionMeasurement& measured : outcomes[i].sections) {
      if (!fresh) measured.porosity.warnings.emplace_back("is listed again: it counts twice");
      const double scatter = calib::scatter_of(calib::pool_sections({measured.porosity}), {});
      found.entries.push_back(io::porosity_json(measured.porosity, scatter));
      found.sections.push_back({image, std::move(measured), scatter});
    }
  }
  return found;
}

// All sections are pooled as a fit pools those of one specimen (calib/porosity, K1).
calib::SpecimenPorosity mean_of(const std::vector<Section>& sections) {
  std::vector<calib::SectionPorosity> all;
  all.reserve(sections.size());
  for (const Section& section : sections) all.push_back(section.measured.porosity);
  return calib::pool_sections(all);
}

void print_table(const std::vector<Section>& sections) {
  fmt::print("porosity [%]   +-    pores   window SD [%]   scatter  section\n");
  for (const Section& section : sections) {
    const calib::SectionPorosity& found = section.measured.porosity;
    // Pores larger than a window remove joints rather than spread their strength (K5).
    const bool missing = calib::removes_joints(calib::pool_sections({found}));
    fmt::print("{:>12.3f}{:>7}{:>7}{:>16}{:>10}  {}\n", 100.0 * found.porosity,
               cell(100.0 * found.porosity_standard_error, 3), found.pore_count,
               cell(100.0 * found.window_sd, 3), missing ? "missing" : cell(section.scatter, 3),
               found.file);
    for (const std::string& warning : found.warnings) fmt::print("  note: {}\n", warning);
    if (std::isfinite(found.density))
      fmt::print(
          "  density of solid bone {:.0f} kg/m³, {}\n", found.density,
          std::isfinite(found.density_residual)
              ? fmt::format("references {:.0f} kg/m³ about their line", found.density_residual)
              : "two references: no check of their line");
  }
  const calib::SpecimenPorosity mean = mean_of(sections);
  if (sections.size() > 1)
    fmt::print("{:>12.3f}{:>7}{:>23}{:>10}  all, by area\n", 100.0 * mean.porosity,
               cell(100.0 * mean.porosity_standard_error, 3), cell(100.0 * mean.window_sd, 3),
               calib::removes_joints(mean) ? "missing" : cell(calib::scatter_of(mean, {}), 3));
  if (calib::removes_joints(mean))
    fmt::print(
        "  note: pores are larger than a window of one fibre: they take away {:.1f} % of the "
        "joints rather than spread their strength\n",
        100.0 * calib::missing_joints(mean));
}

// Overlays are also files beside the page; images of the same name get different ones.
void write_page(const OutputFolder& output, const PorosityFindings& found,
                const CommonOptions& common, const Stopwatch& watch) {
  reports::PorosityReport page;
  std::set<std::string> used;
  for (const Section& section : found.sections) {
    const auto& overlay = section.measured.overlay_png;
    const std::string name = name_of_its_own(section.image.stem().string(), used);
    output.write(name + "_overlay.png", {overlay.begin(), overlay.end()});
    page.sections.push_back(section.measured.porosity);
    page.overlays.push_back(overlay);
    page.scatter.push_back(section.scatter);
    page.histograms.push_back(section.measured.histogram);
  }
  page.mean = mean_of(found.sections);
  page.provenance = provenance_of(common, digests_of(found.read), watch);
  if (reports::available()) output.write("report.html", reports::porosity_page(page));
}

int run_porosity(const PorosityArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  refuse_settings(common, "havers porosity reads no study");
  std::vector<std::filesystem::path> inputs = arguments.images;
  if (!arguments.mask.empty()) inputs.push_back(arguments.mask);
  std::optional<OutputFolder> output;  // refused before anything is measured
  if (!arguments.folder.empty()) output.emplace(arguments.folder, common.force, inputs);
  PorosityFindings found = measure_all(arguments);
  nlohmann::json json = json_of_files("sections", found.entries, arguments.images.size());
  // If nothing was measured no folder is made.
  if (found.sections.empty())
    output.reset();
  else
    json["mean"] = io::mean_porosity_json(mean_of(found.sections));
  if (output) output->write("porosity.json", io::json_text(json));
  if (output) write_page(*output, found, common, watch);
  answer(common, output ? &*output : nullptr, json, page_or("porosity.json"), [&] {
    if (!found.sections.empty()) print_table(found.sections);
  });
  // Last, so that what could be measured is shown before; the JSON has the problems already.
  return found.problems.empty() ? done : refuse(io::InputError(std::move(found.problems)));
}

// An option whose values are the words of input files.
template <class E>
void add_words(CLI::App& parser, const std::string& name, E& value, const std::string& meaning) {
  std::map<std::string, E> known;
  for (std::size_t i = 0; i < io::words<E>.size(); ++i)
    known.emplace(io::words<E>.at(i), static_cast<E>(i));
  const auto number_of_word = [known](std::string& text) -> std::string {
    const auto found = known.find(text);
    if (found == known.end())
      return fmt::format("is {}, must be one of: {}", text, fmt::join(io::words<E>, ", "));
    // CLI11 reads an enumeration from its number.
    text = std::to_string(static_cast<int>(found->second));
    return {};
  };
  parser.add_option(name, value, fmt::format("{}: {}", meaning, fmt::join(io::words<E>, ", ")))
      ->transform(CLI::Validator(number_of_word, ""))
      ->type_name("WORD");
}

}  // namespace

Command porosity_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(
      app, common, "porosity", "porosity of sections, measured on their images", porosity_examples);
  say_settings_are_refused(*parser);
  const auto arguments = std::make_shared<PorosityArguments>();
  io::SectionOptions& options = arguments->options;
  parser->add_option("IMAGE", arguments->images, "PNG, TIFF, JPEG, BMP or DICOM")->required();
  add_output(*parser, arguments->folder, "folder for overlays and a page");
  parser
      ->add_option("--pixel-size-um", arguments->pixel_size_um,
                   "size of a pixel; default: the file's own tag")
      ->check(above_zero());
  parser->add_flag("--any-pixel-size", options.any_pixel_size, "sizes outside 0.1 to 200 um too");
  parser->add_option("--mask", arguments->mask, "image that is white where the bone is")
      ->type_name("FILE");
  parser->add_flag("--fills-image", options.fills_image,
                   "bone is everywhere: no outline is looked for");
  add_words(*parser, "--pores", options.pores, "whether pores are dark or bright");
  add_words(*parser, "--threshold", options.threshold, "where pores end");
  parser->add_option("--rim-um", arguments->rim_um, "depth of bone left out below its surfaces")
      ->check(not_negative());
  parser
      ->add_option("--crack-slenderness", options.crack_slenderness,
                   "length over width from which on it is a crack; 0: none is")
      ->check(not_negative())
      ->capture_default_str();
  parser->add_option("--density", arguments->density, "a known material: grey level or rectangle")
      ->allow_extra_args(false)
      ->type_name("GREY=KG_M3");
  parser
      ->add_option("--fibre-length-um", arguments->fibre_length_um,
                   "of the window whose porosity spreads")
      ->check(above_zero())
      ->capture_default_str();
  parser->add_option("--fibre-height-um", arguments->fibre_height_um, "of that window")
      ->check(above_zero())
      ->capture_default_str();
  return {parser, [arguments, &common] { return run_porosity(*arguments, common); }};
}

}  // namespace havers::cli
