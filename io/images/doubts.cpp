// (I17), (I18) One function for each group of reasons. Most sentences say what was seen, and what
// to do if that is not what was meant.
#include "io/images/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "calib/count.hpp"
#include "io/images/masks.hpp"

namespace havers::images {
namespace {

// Not a doubt about the porosity, which no pixel size changes.
void warn_of_canals(const calib::SectionPorosity& section, Warnings& warnings) {
  if (!calib::pores_may_be_canals(section))
    warnings.push_back(
        fmt::format("pores are {:.2g} µm wide (mean by area), unlike canals in bone (10 to 500 "
                    "µm): is the pixel size, {:g} µm, right?",
                    1e6 * calib::usual_pore_diameter(section), 1e6 * section.pixel_size));
}

// No background; or bone that may be pores, as it is little of the image or in many parts.
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
    // A strip of more than a third of the image is a bar that spans it, not a label.
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

// Neither the frame nor pores tell which of two regions is the bone.
void warn_of_sides_of_frame(const Regions& regions, io::Pores known, Warnings& warnings) {
  if (!regions.either_is_bone || known != io::Pores::found) return;
  const bool bright = regions.dark_pores;
  warnings.push_back(fmt::format(
      "bone and background both reach the image's edge, and pores do not tell them apart: the "
      "{}er is taken for bone; if it is the other, say --pores {} (in a study pores = \"{}\") or "
      "give a mask",
      bright ? "bright" : "dark", bright ? "bright" : "dark", bright ? "bright" : "dark"));
}

// Whether more than nine tenths of the bone have channels less than a sixteenth of the range apart.
bool is_grey(const PoreMap& map, const cv::Mat& colours) {
  return colours.empty() ||
         cv::countNonZero((colours < 16) & map.bone) > 0.9 * cv::countNonZero(map.bone);
}

// In bone that is grey, colours are somebody's lines and letters.
void warn_of_drawings(const PoreMap& map, const cv::Mat& colours, Warnings& warnings) {
  if (colours.empty() || !is_grey(map, colours)) return;
  const int drawn = cv::countNonZero((colours > 64) & map.bone);
  if (drawn >= smallest_pore)
    warnings.push_back(
        fmt::format("{:.2g} % of the bone is coloured, and the rest is grey: if that is drawn into "
                    "the image, measure the image without it",
                    100.0 * drawn / cv::countNonZero(map.bone)));
}

// Osteons a little darker than the bone about them pass for pores, pores filled in part for bone.
// `like_background`: a background is seen that is to be compared with; stain has hues of its own.
void warn_of_greys(const PoreMap& map, bool like_background, Warnings& warnings) {
  constexpr double faint = 0.6;  // of the background's contrast
  if (map.areas.empty()) return;
  if (like_background && map.contrast < faint)
    warnings.push_back(
        fmt::format("pores differ from bone by {:.0f} % only of what the background does: if that "
                    "is {}er bone, as of osteons, give the image in two values; if pores are as "
                    "faint, give a mask",
                    100.0 * map.contrast, map.dark ? "dark" : "bright"));
  if (map.half_deep > 0.1 * map.area)
    warnings.push_back(fmt::format(
        "{:.2g} % of the bone is more than half way to the threshold and not near a pore: if that "
        "is pores, filled in part, give the image in two values",
        100.0 * map.half_deep / cv::countNonZero(map.bone)));
}

// No pores; pores on the other side of bone than the background; much of the bone as far from its
// level as pores are, but on their other side.
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

// A pore that is too large to be one; (I7) and (I8) that differ.
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

// (I5) What the surface cuts is no larger than what it does not; chips and saw cuts are.
void warn_of_chips(const PoreMap& map, Warnings& warnings) {
  constexpr double larger = 1.5, much = 0.05;
  const cv::Mat inside = eroded(map.bone, 5);
  double cut = 0.0, largest_cut = 0.0, largest_whole = 0.0;
  for (const Blob& pore : blobs_of(map.pores)) {
    const bool whole = std::ranges::all_of(
        pore.border, [&](const cv::Point& at) { return inside.at<std::uint8_t>(at) != 0; });
    double& largest = whole ? largest_whole : largest_cut;
    largest = std::max(largest, pore.area);
    cut += whole ? 0.0 : pore.area;
  }
  if (largest_cut > larger * largest_whole && cut > much * map.area)
    warnings.push_back(fmt::format(
        "the largest notch in the bone's outline is {:.2g} % of the bone, larger than every pore "
        "inside ({:.2g} %): if it is a chip or a cut, no pore, give a mask without it",
        100.0 * largest_cut / cv::countNonZero(map.bone),
        100.0 * largest_whole / cv::countNonZero(map.bone)));
}

}  // namespace

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

void add_doubts(const Findings& found, const io::SectionOptions& options, Warnings doubts,
                calib::SectionPorosity& section) {
  const auto& [whole, all_colours, map, regions] = found;
  const cv::Mat colours = all_colours.empty() ? all_colours : all_colours(regions.box);
  const bool like_background = map.dark == regions.dark_pores;
  Warnings warnings;
  // If all of the bone is a strip, that it is little of the image adds nothing.
  if (!warn_of_strips(map, regions.box, whole.size(), doubts))
    warn_of_bone(map, regions.outlined, whole.size(), options, doubts);
  warn_of_sides_of_frame(regions, options.pores, doubts);
  warn_of_background(whole, map, regions.box, options, doubts);
  warn_of_drawings(map, colours, doubts);
  warn_of_greys(map, regions.outlined && like_background && is_grey(map, colours), doubts);
  warn_of_side(map, !regions.outlined || like_background, options.pores, doubts);
  warn_of_size(map, section, doubts);
  if (regions.outlined && !options.mask) warn_of_chips(map, doubts);
  warn_of_objects(map, doubts, warnings);
  warn_of_canals(section, warnings);
  if (!options.density.empty() && std::isnan(section.density))
    warnings.emplace_back(
        "density stays unknown: nowhere is bone two pixels from its surface, pores and cracks");
  // `warnings` do not question the porosity itself: they do not make the section doubtful.
  section.doubtful = !doubts.empty();
  std::ranges::move(warnings, std::back_inserter(doubts));
  section.warnings = std::move(doubts);
}

}  // namespace havers::images
