#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "calib/count.hpp"
#include "io/images/density.hpp"
#include "io/images/grey_image.hpp"
#include "io/images/image_library.hpp"
#include "io/images/masks.hpp"
#include "io/images/overlay.hpp"
#include "io/images/pixel_size_tag.hpp"
#include "io/images/pores.hpp"
#include "io/images/section_quantities.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

using Warnings = std::vector<std::string>;

void warn_of_scale(const io::SectionOptions& options, Warnings& warnings) {
  if (!options.pixel_size)
    warnings.emplace_back(
        "no pixel size is known: areas and the spread between windows stay unknown; give "
        "--pixel-size-um, in a study pixel_size_um");
  else if (*options.pixel_size > options.window_height)
    warnings.push_back(
        fmt::format("a pixel ({:g} µm) is larger than the fibre's height ({:g} µm): the spread "
                    "between windows is that of the pixels",
                    *options.pixel_size * 1e6, options.window_height * 1e6));
}

// Not a doubt about the porosity, which no pixel size changes.
void warn_of_canals(const calib::SectionPorosity& section, Warnings& warnings) {
  if (!calib::pores_may_be_canals(section))
    warnings.push_back(
        fmt::format("pores are {:.2g} µm wide (mean by area), unlike canals in bone (10 to 500 "
                    "µm): is the pixel size, {:g} µm, right?",
                    1e6 * calib::usual_pore_diameter(section), 1e6 * section.pixel_size));
}

void warn_of_bone(const PoreMap& map, bool outlined, cv::Size image,
                  const io::SectionOptions& options, Warnings& warnings) {
  if (options.mask || options.fills_image) return;
  const double share = cv::countNonZero(map.bone) / static_cast<double>(image.area());
  const auto parts = static_cast<long>(outer_contours(map.bone).size());
  if (!outlined)
    warnings.emplace_back(
        "no background was found, so bone is taken to fill the image: if it does, say so with "
        "--fills-image (in a study fills_image = true), if not, give a mask");
  else if (share < 0.1 || parts > 10)
    warnings.push_back(
        fmt::format("the bone is {:.1f} % of the image, in {}: if that is pores in bone that fills "
                    "the image, say --fills-image (in a study fills_image = true)",
                    100.0 * share, calib::count(parts, "part")));
}

// Where the user says what is bone, but the image shows a background around it.
void warn_of_background(const cv::Mat& whole, const PoreMap& map, cv::Rect box,
                        const io::SectionOptions& options, Warnings& warnings) {
  if (!options.mask && !options.fills_image) return;
  const Regions found = divide(whole, options.pores);
  if (!found.outlined) return;
  cv::Mat elsewhere = cv::Mat(whole.size(), CV_8U, cv::Scalar(255));
  elsewhere(found.box) &= ~found.search;
  const double share =
      cv::countNonZero(elsewhere(box) & map.bone) / static_cast<double>(cv::countNonZero(map.bone));
  if (share > 0.01)
    warnings.push_back(fmt::format(
        "{:.0f} % of {} looks like background around a bone: if it is, {}", 100.0 * share,
        options.mask ? "the mask" : "the image",
        options.mask ? "make the mask smaller" : "do not say that bone fills the image"));
}

// As bright as the bone, a strip with a scale or a label passes for a second piece of it; or, as it
// has less of the image, for all of it: then true is returned.
bool warn_of_strips(const PoreMap& map, cv::Rect box, cv::Size image, Warnings& warnings) {
  constexpr int blur = 4;          // [px]
  constexpr int widest_label = 3;  // in the image
  const std::vector<Contour> parts = outer_contours(map.bone);
  const bool all = parts.size() == 1;
  bool warned = false;
  for (const Contour& part : parts) {
    const cv::Rect at = cv::boundingRect(part) + box.tl();
    const bool lies =
        at.width > image.width - blur && (at.y < blur || at.br().y > image.height - blur);
    const bool stands =
        at.height > image.height - blur && (at.x < blur || at.br().x > image.width - blur);
    if (!lies && !stands) continue;
    if (all && widest_label * at.area() > image.area()) continue;
    warnings.push_back(
        fmt::format("{} is a strip along an edge of the image: if it is a label, cut it off or "
                    "give a mask",
                    all ? "all that is taken for bone"
                        : fmt::format("{:.1f} % of the bone",
                                      100.0 * enclosed_area(part) / cv::countNonZero(map.bone))));
    warned = true;
  }
  return all && warned;
}

// In bone that is grey, colours are somebody's lines and letters.
void warn_of_drawings(const PoreMap& map, const cv::Mat& colours, Warnings& warnings) {
  if (colours.empty()) return;
  const double bone = cv::countNonZero(map.bone);
  const int grey = cv::countNonZero((colours < 16) & map.bone);
  const int drawn = cv::countNonZero((colours > 64) & map.bone);
  if (grey > 0.9 * bone && drawn >= smallest_pore)
    warnings.push_back(
        fmt::format("{:.2g} % of the bone is coloured, and the rest is grey: if that is drawn into "
                    "the image, measure the image without it",
                    100.0 * drawn / bone));
}

void warn_of_side(const PoreMap& map, bool like_background, io::Pores known, Warnings& warnings) {
  const std::string_view side = map.dark ? "dark" : "bright", other = map.dark ? "bright" : "dark";
  if (map.areas.empty() && map.crack_count + map.specks == 0)
    warnings.emplace_back("no pores were found: no patch lies five deviations apart from bone");
  if (!map.areas.empty() && !like_background && known == io::Pores::found)
    warnings.push_back(fmt::format(
        "pores are taken to be {}er than bone, which the background is not: if that is wrong, say "
        "--pores {} (in a study pores = \"{}\")",
        side, other, other));
  if (map.other_side > 0.005)
    warnings.push_back(
        fmt::format("{:.1f} % of the bone is as much {}er than bone as pores are {}er, and does "
                    "not count as pores",
                    100.0 * map.other_side, other, side));
}

void warn_of_objects(const PoreMap& map, Warnings& doubts, Warnings& warnings) {
  if (map.specks > 0)
    warnings.push_back(fmt::format("{} below {} pixels {} left out as too small to tell from noise",
                                   calib::count(map.specks, "object"), smallest_pore,
                                   map.specks == 1 ? "was" : "were"));
  // Canals cut lengthwise are as slender: where cracks outweigh the pores, they may be these.
  Warnings& told = map.crack_area > map.area ? doubts : warnings;
  if (map.crack_count > 0)
    told.push_back(fmt::format(
        "{}, {:.2f} % of the bone, {}", calib::count(map.crack_count, "long and narrow object"),
        100.0 * map.crack_area / cv::countNonZero(map.bone),
        map.crack_count == 1 ? "was taken for a crack and does not count as a pore"
                             : "were taken for cracks and do not count as pores"));
}

void warn_of_size(const PoreMap& map, const calib::SectionPorosity& section, Warnings& warnings) {
  const double bone = cv::countNonZero(map.bone);
  const double largest = map.areas.empty() ? 0.0 : std::ranges::max(map.areas);
  if (largest > 0.05 * bone)
    warnings.push_back(
        fmt::format("one pore takes {:.1f} % of the bone: if it is the marrow cavity, or the "
                    "background inside a frame, give a mask without it",
                    100.0 * largest / bone));
  if (std::abs(section.porosity - section.porosity_by_grey) > 0.01)
    warnings.push_back(
        fmt::format("the porosity by grey levels, {:.2f} %, differs by more than one point from "
                    "the one by threshold, {:.2f} %",
                    100.0 * section.porosity_by_grey, 100.0 * section.porosity));
}

void leave_out_rim(const io::SectionOptions& options, const std::string& name, cv::Mat& bone) {
  if (options.rim == 0.0) return;
  if (!options.pixel_size)
    throw io::InputError(name, "the rim to leave out is in µm, but no pixel size is known",
                         "give it with --pixel-size-um (in a study pixel_size_um)");
  const double across = bone.rows + bone.cols;  // no rim reaches further
  const int reach = cvRound(std::min(options.rim / *options.pixel_size, across));
  if (reach == 0)
    throw io::InputError(name, "the rim to leave out is less than half a pixel",
                         "give more, or none");
  bone = eroded_by(bone, reach);
  if (cv::countNonZero(bone) == 0)
    throw io::InputError(name, "the rim to leave out takes all of the bone", "give less, or none");
}

std::string method_of(io::Threshold threshold) {
  switch (threshold) {
    case io::Threshold::half_maximum:
      break;
    case io::Threshold::otsu:
      return "Otsu after flat field";
    case io::Threshold::sauvola:
      return "Sauvola after flat field";
  }
  return "half-maximum after flat field, corrected for blur";
}

Regions regions_of(const cv::Mat& whole, const io::SectionOptions& options, Warnings& warnings) {
  if (options.mask)
    return divide(whole, read_mask(*options.mask, whole.size(), warnings), options.pores);
  if (options.fills_image)
    return divide(whole, cv::Mat(whole.size(), CV_8U, cv::Scalar(255)), options.pores);
  return divide(whole, options.pores);
}

// One level alone may be bone, or no section at all.
void refuse_nothing(const PoreMap& map, const Regions& regions, const std::string& name,
                    const io::SectionOptions& options) {
  if (regions.outlined || options.mask || options.fills_image) return;
  if (map.areas.empty() && map.crack_count == 0)
    throw io::InputError(
        name, "shows no bone: neither a background nor pores differ from the rest",
        "if bone without pores fills it, say --fills-image, in a study fills_image = true");
}

// Levels along a colour's own axis are not those of the file.
void refuse_levels_of_colour(const cv::Mat& image, const std::string& name,
                             const std::vector<io::DensityReference>& references) {
  const bool in_levels = std::ranges::any_of(
      references, [](const io::DensityReference& known) { return known.width == 0; });
  if (in_levels && !is_grey(image))
    throw io::InputError(name, "grey levels mean nothing in a colour image",
                         "give rectangles for density");
}

io::SectionMeasurement measure_page(cv::Mat image, const std::string& name,
                                    const io::SectionOptions& options) {
  const cv::Mat whole = to_grey(image, name);
  refuse_levels_of_colour(image, name, options.density);
  const cv::Mat colours = colourfulness(image);
  image.release();
  Warnings doubts, warnings;
  Regions regions = regions_of(whole, options, doubts);
  const cv::Mat grey = whole(regions.box);
  Depth depth{.levels = bone_levels(grey, regions)};
  cv::Mat bone = find_bone(grey, regions, depth);
  if (!bone.empty()) leave_out_rim(options, name, bone);
  if (bone.empty() || cv::countNonZero(bone) == 0)
    throw io::InputError(name, "no bone was found", "give a mask that is white where the bone is");
  const PoreMap map = find_pores(grey, bone,
                                 {.threshold = options.threshold,
                                  .crack_slenderness = options.crack_slenderness,
                                  .pores = options.pores,
                                  .rim = regions.outlined},
                                 depth);
  refuse_nothing(map, regions, name, options);

  io::SectionMeasurement measured{.porosity = section_quantities(map, regions.outlined, options)};
  measured.porosity.file = name;
  measured.porosity.method = method_of(options.threshold);
  add_density(whole, grey, map, options.density, measured.porosity);
  if (!warn_of_strips(map, regions.box, whole.size(), doubts))
    warn_of_bone(map, regions.outlined, whole.size(), options, doubts);
  warn_of_background(whole, map, regions.box, options, doubts);
  warn_of_drawings(map, colours.empty() ? colours : colours(regions.box), doubts);
  warn_of_side(map, !regions.outlined || map.dark == regions.dark_pores, options.pores, doubts);
  warn_of_size(map, measured.porosity, doubts);
  warn_of_objects(map, doubts, warnings);
  warn_of_canals(measured.porosity, warnings);
  if (!options.density.empty() && std::isnan(measured.porosity.density))
    warnings.emplace_back(
        "density stays unknown: nowhere is bone two pixels from its surface, pores and cracks");
  measured.porosity.doubtful = !doubts.empty();
  std::ranges::move(warnings, std::back_inserter(doubts));
  measured.porosity.warnings = std::move(doubts);
  if (!options.pictures) return measured;
  measured.overlay_png = draw_overlay(whole, map, regions.box);
  measured.histogram = histogram_of(depth, map);
  return measured;
}

}  // namespace

std::vector<io::SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                     const io::SectionOptions& given) {
  io::SectionOptions options = given;
  Warnings warnings;
  options.pixel_size = pixel_size_of(image, given, warnings);
  warn_of_scale(options, warnings);
  std::vector<cv::Mat> pages = read_pages(image);
  std::vector<io::SectionMeasurement> measured;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::string name =
        pages.size() == 1 ? image.string() : fmt::format("{} page {}", image.string(), i + 1);
    measured.push_back(measure_page(std::move(pages[i]), name, options));
    auto& all = measured.back().porosity.warnings;
    all.insert(all.begin(), warnings.begin(), warnings.end());
  }
  return measured;
}

}  // namespace havers::images
