// Student's t without a table: for few degrees of freedom its distribution has a closed form.
#pragma once

#include <cassert>
#include <cmath>
#include <numbers>

namespace havers::test {

/// Probability beyond t, for 1, 2 or 3 degrees of freedom.
inline double student_tail(double t, int freedom) {
  assert(freedom >= 1 && freedom <= 3);
  if (freedom == 1) return 0.5 - std::atan(t) / std::numbers::pi;
  if (freedom == 2) return 0.5 - 0.5 * t / std::sqrt(2.0 + t * t);
  const double s = t / std::sqrt(3.0);
  return 0.5 - (s / (1.0 + s * s) + std::atan(s)) / std::numbers::pi;
}

}  // namespace havers::test
