// The whole chain, page by page: grey, regions, levels, bone, pores, quantities, doubts. Once the
// regions are known, most steps see only the box around the bone, which may be a small part of the
// image.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "calib/count.hpp"
#include "io/images/density.hpp"
#include "io/images/doubts.hpp"
#include "io/images/grey_image.hpp"
#include "io/images/image_library.hpp"
#include "io/images/masks.hpp"
#include "io/images/overlay.hpp"
#include "io/images/pixel_size_tag.hpp"
#include "io/images/pores.hpp"
#include "io/images/section_quantities.hpp"
#include "io/images/tiff_pages.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// Beyond its box there is no bone, but where the image ends more of it may follow.
cv::Mat eroded_in(const cv::Rect& box, cv::Size image, const cv::Mat& bone, int reach) {
  const int left = std::min(box.x, 1), top = std::min(box.y, 1),
            right = std::min(image.width - box.br().x, 1),
            bottom = std::min(image.height - box.br().y, 1);
  cv::Mat framed;
  cv::copyMakeBorder(bone, framed, top, bottom, left, right, cv::BORDER_CONSTANT, 0);
  return eroded_by(framed, reach)(cv::Rect({left, top}, bone.size())).clone();
}

// Takes the rim off all surfaces of the bone, also at the marrow. The image's edge is no surface.
void leave_out_rim(const io::SectionOptions& options, const std::string& name, const cv::Rect& box,
                   cv::Size image, cv::Mat& bone) {
  if (options.rim == 0.0) return;
  if (!options.pixel_size)
    throw io::InputError(name, "the rim to leave out is in µm, but no pixel size is known",
                         "give it with --pixel-size-um (in a study pixel_size_um)");
  const double across = bone.rows + bone.cols;  // no rim reaches further
  const int reach = cvRound(std::min(options.rim / *options.pixel_size, across));
  if (reach == 0)
    throw io::InputError(name, "the rim to leave out is less than half a pixel",
                         "give more, or none");
  bone = eroded_in(box, image, bone, reach);
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

// The user's mask comes first, then that bone fills the image; without either, bone is looked for.
Regions regions_of(const cv::Mat& whole, const cv::Mat& mask, const io::SectionOptions& options,
                   Warnings& warnings) {
  if (options.mask)
    return divide(whole, to_mask(mask, options.mask->string(), whole.size(), warnings),
                  options.pores);
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

io::SectionMeasurement measure_page(cv::Mat image, const cv::Mat& mask, const std::string& name,
                                    const io::SectionOptions& options) {
  const cv::Mat whole = to_grey(image, name);
  refuse_levels_of_colour(image, name, options.density);
  const cv::Mat colours = colourfulness(image);
  // Frees the memory of a colour image, as the next steps need their own.
  image.release();
  Warnings doubts;
  Regions regions = regions_of(whole, mask, options, doubts);
  // A view, not a copy.
  const cv::Mat grey = whole(regions.box);
  Depth depth{.levels = bone_levels(grey, regions)};
  cv::Mat bone = find_bone(grey, regions, depth);
  if (!bone.empty()) leave_out_rim(options, name, regions.box, whole.size(), bone);
  if (bone.empty() || cv::countNonZero(bone) == 0)
    throw io::InputError(name, "no bone was found", "give a mask that is white where the bone is");
  const PoreMap map = find_pores(grey, bone,
                                 {.threshold = options.threshold,
                                  .crack_slenderness = options.crack_slenderness,
                                  .pores = options.pores,
                                  .rim = regions.outlined},
                                 depth);
  refuse_nothing(map, regions, name, options);

  // Doubts come last, as they also look at the quantities and the density.
  io::SectionMeasurement measured{.porosity = section_quantities(map, regions.outlined, options)};
  measured.porosity.file = name;
  measured.porosity.method = method_of(options.threshold);
  add_density(whole, grey, map, options.density, measured.porosity);
  add_doubts({whole, colours, map, regions}, options, std::move(doubts), measured.porosity);
  if (!options.pictures) return measured;
  measured.overlay_png = draw_overlay(whole, map, regions.box);
  measured.histogram = histogram_of(depth, map);
  return measured;
}

// The numbers of the pages that show sections: the reduced copies in a pyramid of resolutions show
// none that is not there in full.
std::vector<std::size_t> sections_among(const std::vector<cv::Mat>& pages,
                                        const std::filesystem::path& image, Warnings& warnings) {
  FileBytes bytes(image);
  std::vector<std::size_t> full = full_pages(tiff_pages(bytes));
  if (full.empty()) {  // no TIFF
    full.resize(pages.size());
    std::iota(full.begin(), full.end(), std::size_t{0});
  }
  if (full.size() < pages.size())
    warnings.push_back(fmt::format("{} left out: reduced copies of others, by the file's own words",
                                   calib::count(pages.size() - full.size(), "page")));
  return full;
}

// The mask of each section: one page serves them all, more are one for each.
std::vector<cv::Mat> masks_of(const io::SectionOptions& options, std::size_t sections) {
  if (!options.mask) return std::vector<cv::Mat>(sections);
  const std::vector<cv::Mat> pages = read_pages(*options.mask);
  Warnings ignored;  // A reduced copy among masks takes nothing away.
  std::vector<cv::Mat> masks;
  for (const std::size_t i : sections_among(pages, *options.mask, ignored))
    masks.push_back(pages[i]);
  if (masks.size() == 1) masks.resize(sections, masks.front());
  if (masks.size() != sections)
    throw io::InputError(
        options.mask->string(),
        fmt::format("the mask has {}, its image {}", calib::count(masks.size(), "page"),
                    calib::count(sections, "page")),
        "give one page for all, or one for each");
  return masks;
}

}  // namespace

std::vector<io::SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                     const io::SectionOptions& given) {
  io::SectionOptions options = given;
  Warnings warnings;
  // All pages of a file have the same pixel size, and therefore the same warnings of it.
  options.pixel_size = pixel_size_of(image, given, warnings);
  warn_of_scale(options, warnings);
  std::vector<cv::Mat> pages = read_pages(image);
  const std::vector<std::size_t> sections = sections_among(pages, image, warnings);
  const std::vector<cv::Mat> masks = masks_of(options, sections.size());
  std::vector<io::SectionMeasurement> measured;
  for (const std::size_t i : sections) {
    const std::string name =
        sections.size() == 1 ? image.string() : fmt::format("{} page {}", image.string(), i + 1);
    measured.push_back(measure_page(std::move(pages[i]), masks[measured.size()], name, options));
    auto& all = measured.back().porosity.warnings;
    all.insert(all.begin(), warnings.begin(), warnings.end());
  }
  return measured;
}

}  // namespace havers::images
