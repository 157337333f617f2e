// (I13) A line of density over grey level by least squares. Two references determine it; only from
// a third one on does it have a residual.
#include "io/images/density.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "io/images/masks.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// (I13) Two pixels from all that blur mixes into it.
cv::Mat solid_bone(const PoreMap& map) {
  cv::Mat solid = eroded(map.bone, 5) & ~dilated(map.pores, 5);
  if (!map.cracks.empty()) solid &= ~dilated(map.cracks, 5);
  return solid;
}

}  // namespace

void add_density(const cv::Mat& whole, const cv::Mat& bone_grey, const PoreMap& map,
                 const std::vector<io::DensityReference>& references,
                 calib::SectionPorosity& section) {
  section.density_residual = std::numeric_limits<double>::quiet_NaN();
  if (references.empty()) return;
  const cv::Rect image({}, whole.size());
  std::vector<double> grey, density;
  for (const io::DensityReference& known : references) {
    const cv::Rect shown(known.x, known.y, known.width, known.height);
    if (known.width > 0 && (shown & image) != shown)
      throw io::InputError(section.file, "a phantom's rectangle leaves the image",
                           "give x, y, width and height in pixels from the upper left corner");
    grey.push_back(known.width > 0 ? cv::mean(whole(shown))[0] : known.grey);
    density.push_back(known.density);
  }
  const auto n = static_cast<double>(grey.size());
  const cv::Scalar middle = cv::mean(grey), level = cv::mean(density);
  double spread = 0.0, common = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    spread += std::pow(grey[i] - middle[0], 2);
    common += (grey[i] - middle[0]) * (density[i] - level[0]);
  }
  if (!(spread > 0.0))
    throw io::InputError(section.file, "density needs two materials of different grey level");
  const auto at = [&](double g) { return level[0] + common / spread * (g - middle[0]); };
  for (std::size_t i = 0; i < grey.size(); ++i) squares += std::pow(density[i] - at(grey[i]), 2);
  const cv::Mat solid = solid_bone(map);
  // Density stays NaN, and add_doubts warns of it.
  if (cv::countNonZero(solid) == 0) return;
  section.density = at(cv::mean(bone_grey, solid)[0]);
  // Such a line results, for instance, where the densities of two references are swapped.
  if (section.density < 0.0)
    throw io::InputError(
        section.file,
        fmt::format("solid bone has a density of {:.0f} kg/m³ by these materials", section.density),
        "give each grey level or rectangle the density of what it shows");
  if (references.size() > 2) section.density_residual = std::sqrt(squares / n);
}

}  // namespace havers::images
