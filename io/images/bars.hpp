// Whether an outline is that of a sawn bar. Private to io/images.
#pragma once

#include "io/images/masks.hpp"

namespace havers::images {

/// Whether the convex hull fills 95 % of a rectangle.
bool is_a_machined_bar(const Contour& border);

/// Whether each side of the hull is the outline's own for half of its length: crests of waves are
/// not.
bool has_straight_sides(const Contour& border);

}  // namespace havers::images
