// Files to channels: PNG by libdeflate where it can, all else by OpenCV. Damage is looked for
// before pixels are used, as decoders fill in what is missing without a word.
#include "io/images/grey_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "io/images/cut_off.hpp"
#include "io/images/png.hpp"
#include "io/images/silence.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// Decoders only say that a file is unreadable: here each reason for that has its own message.
void check_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found)
    throw io::InputError(file.string(), "there is no such file",
                         "check the path; a study's are relative to its folder");
  if (std::filesystem::is_directory(file, error))
    throw io::InputError(file.string(), "is a folder, not an image", "name the images in it");
  if (!std::ifstream(file))
    throw io::InputError(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  if (!std::filesystem::is_regular_file(file, error))
    throw io::InputError(file.string(), "is a device, not an image", "name an image's file");
  if (std::filesystem::file_size(file) == 0)
    throw io::InputError(file.string(), "is an empty file", "export the image again");
}

std::vector<cv::Mat> decoded(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png")
    // An empty image may mean a damaged file, of which check_is_whole complains.
    if (cv::Mat image = read_png(file); !image.empty()) return {image};
  check_is_whole(file);
  const Silence silence;
  std::vector<cv::Mat> pages;
  // imread reads only the first page.
  if (ending == ".tif" || ending == ".tiff")
    cv::imreadmulti(file.string(), pages, cv::IMREAD_UNCHANGED);
  else
    pages = {cv::imread(file.string(), cv::IMREAD_UNCHANGED)};
  return pages;
}

// What a channel reaches where it is full; of floats, which have no such value, its largest.
double full_of(const cv::Mat& channels) {
  if (channels.depth() == CV_8U) return 255.0;
  if (channels.depth() == CV_16U) return 65535.0;
  double highest = 0.0;
  cv::minMaxLoc(channels.reshape(1), nullptr, &highest);
  return highest;
}

// 255 where the fourth channel, alpha, is less than half opaque.
cv::Mat hidden_in(const cv::Mat& image) {
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  return alpha < 0.5 * full_of(alpha);
}

// What is transparent takes the colour, black or white, that is farther from the opaque pixels'
// mean.
cv::Mat without_alpha(const cv::Mat& image) {
  cv::Mat colour;
  cv::cvtColor(image, colour, cv::COLOR_BGRA2BGR);
  const cv::Mat hidden = hidden_in(image);
  if (cv::countNonZero(hidden) == 0) return colour;
  cv::Mat visible;
  cv::bitwise_not(hidden, visible);
  const cv::Scalar mean = cv::mean(colour, visible);
  const double full = full_of(colour);
  // A mean is bright if its three channels add up to more than half of three full ones.
  const double paper = mean[0] + mean[1] + mean[2] > 1.5 * full ? 0.0 : full;
  colour.setTo(cv::Scalar::all(paper), hidden);
  return colour;
}

// An image of grey and alpha as blue, green, red and alpha.
cv::Mat grey_with_alpha(const cv::Mat& image) {
  cv::Mat colour(image.size(), CV_MAKETYPE(image.depth(), 4));
  cv::mixChannels({image}, {colour}, {0, 0, 0, 1, 0, 2, 1, 3});
  return colour;
}

// (I1): projection on the first principal axis of the colours, which is grey itself for a grey
// image and the stain's colour for a stained one. Its sign follows brightness.
cv::Mat along_main_colour(cv::Mat colour) {
  if (is_grey(colour)) {
    cv::Mat grey;
    cv::extractChannel(colour, grey, 0);
    return grey;
  }
  // Floats have no full level: their own range is stretched to 16 bits.
  if (colour.depth() == CV_32F)
    cv::normalize(colour, colour, 0.0, 65535.0, cv::NORM_MINMAX, CV_16U);
  // A copy of at most 100 × 100 pixels is enough to find the axis.
  cv::Mat few;
  cv::resize(colour, few, fitted(colour.size(), 100), 0.0, 0.0, cv::INTER_NEAREST);
  few.convertTo(few, CV_32F);
  const cv::PCA axes(few.reshape(1, static_cast<int>(few.total())), cv::noArray(),
                     cv::PCA::DATA_AS_ROW, 1);
  cv::Mat weights = axes.eigenvectors.clone();
  // The sign of an eigenvector is arbitrary: brighter shall be more.
  if (cv::sum(weights)[0] < 0.0) weights *= -1.0;
  // In strips, or floats of all channels would take many times the image's own memory.
  const double scale = colour.depth() == CV_8U ? 100.0 : 0.25;  // √3 · 65535 · 0.25 fits
  // The colour half way between black and white becomes the middle of 16 bits.
  const double middle = cv::sum(weights)[0] * (colour.depth() == CV_8U ? 127.5 : 32767.5);
  cv::Mat grey(colour.size(), CV_16U), bands, line;
  for (int y = 0; y < colour.rows; y += 32) {
    const cv::Range rows(y, std::min(y + 32, colour.rows));
    colour.rowRange(rows).convertTo(bands, CV_32F);
    cv::transform(bands, line, weights);
    line.convertTo(grey.rowRange(rows), CV_16U, scale, 32767.5 - scale * middle);
  }
  return grey;
}

}  // namespace

std::vector<cv::Mat> read_pages(const std::filesystem::path& file) {
  check_file(file);
  std::vector<cv::Mat> pages;
  try {
    pages = decoded(file);
  } catch (const cv::Exception&) {
    throw io::InputError(file.string(), "cannot be decoded: it is damaged, or too large",
                         "export it again, in parts where it has more than 2^30 pixels");
  }
  if (pages.empty() || pages.front().empty())
    throw io::InputError(file.string(), "is not a readable image",
                         "use PNG, TIFF, JPEG, BMP or DICOM");
  check_all_was_read(file, pages.size());
  // Later steps handle 8 bits, 16 bits and float only; one NaN would spoil every mean.
  for (cv::Mat& page : pages) {
    if (page.depth() == CV_8U || page.depth() == CV_16U) continue;
    page.convertTo(page, CV_32F);
    if (!cv::checkRange(page))
      throw io::InputError(file.string(), "holds pixels that are no finite numbers",
                           "replace them by the background's value");
  }
  return pages;
}

bool is_grey(const cv::Mat& image) {
  if (image.channels() < 3) return true;
  std::vector<cv::Mat> channels;
  for (int y = 0; y < image.rows; y += 32) {  // in strips, as above
    cv::split(image.rowRange(y, std::min(y + 32, image.rows)), channels);
    if (cv::norm(channels[0], channels[1], cv::NORM_INF) > 0.0 ||
        cv::norm(channels[0], channels[2], cv::NORM_INF) > 0.0)
      return false;
  }
  return true;
}

cv::Mat colourfulness(const cv::Mat& image) {
  if (is_grey(image)) return {};
  const double scale = 255.0 / full_of(image);
  cv::Mat spread(image.size(), CV_8U);
  std::vector<cv::Mat> channels;
  for (int y = 0; y < image.rows; y += 32) {  // in strips, as above
    const cv::Range rows(y, std::min(y + 32, image.rows));
    cv::split(image.rowRange(rows), channels);
    const cv::Mat high = cv::max(cv::max(channels[0], channels[1]), channels[2]);
    const cv::Mat low = cv::min(cv::min(channels[0], channels[1]), channels[2]);
    cv::Mat(high - low).convertTo(spread.rowRange(rows), CV_8U, scale);
  }
  return spread;
}

cv::Mat to_grey(const cv::Mat& image, const std::string& name) {
  double lowest = 0.0, highest = 0.0;
  cv::minMaxLoc(image.reshape(1), &lowest, &highest);
  if (lowest == highest)
    throw io::InputError(name, fmt::format("every pixel has the same value ({:g})", lowest),
                         "this image is empty");
  switch (image.channels()) {
    case 1:
      return image;
    case 2:
      return along_main_colour(without_alpha(grey_with_alpha(image)));
    case 3:
      return along_main_colour(image);
    default:
      return along_main_colour(without_alpha(image));
  }
}

cv::Mat to_mask(cv::Mat mask, const std::string& name, cv::Size size,
                std::vector<std::string>& warnings) {
  if (mask.size() != size)
    throw io::InputError(name,
                         fmt::format("the mask is {} × {} pixels, its image {} × {}", mask.cols,
                                     mask.rows, size.width, size.height),
                         "draw the mask on the image itself");
  if (mask.channels() == 2) mask = grey_with_alpha(mask);
  if (mask.channels() == 4) {  // what is not seen is not bone
    const cv::Mat hidden = hidden_in(mask);
    cv::cvtColor(mask, mask, cv::COLOR_BGRA2BGR);
    mask.setTo(cv::Scalar::all(0.0), hidden);
  }
  if (mask.channels() == 3) cv::cvtColor(mask, mask, cv::COLOR_BGR2GRAY);
  double highest = 0.0;
  cv::minMaxLoc(mask, nullptr, &highest);
  if (highest == 0.0) throw io::InputError(name, "the mask marks nothing", "paint the bone white");
  // A blurred edge is grey; a photograph given instead of its mask is grey nearly everywhere.
  const double grey = cv::countNonZero((mask > 0.1 * highest) & (mask < 0.9 * highest));
  if (const double part = grey / size.area(); part > 0.05)  // more than the blur of its edges
    warnings.push_back(fmt::format(
        "{:.0f} % of the mask {} are neither black nor white: what is brighter than half of its "
        "brightest is taken for bone",
        100.0 * part, name));
  // Relative to its own brightest pixel, so that masks of 0 and 1 serve too.
  return mask > 0.5 * highest;
}

cv::Size fitted(cv::Size size, int side) {
  const double scale = std::min(1.0, static_cast<double>(side) / std::max(size.width, size.height));
  return {std::max(1, cvRound(scale * size.width)), std::max(1, cvRound(scale * size.height))};
}

}  // namespace havers::images
