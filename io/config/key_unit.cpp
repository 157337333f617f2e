#include "io/config/key_unit.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace havers::io {

double from_si(double si, KeyUnit unit) {
  // The quotient is rounded, and may miss the number of the file by a bit. Rounded to fifteen
  // digits it is a short number as it was written; for a longer one its neighbours are tried.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nearest = si * unit.over / unit.times;
  const double rounded = std::strtod(fmt::format("{:.15g}", nearest).c_str(), nullptr);
  for (const double candidate : std::array{rounded, nearest, std::nextafter(nearest, infinity),
                                           std::nextafter(nearest, -infinity)})
    if (to_si(candidate, unit) == si) return candidate;
  return nearest;
}

}  // namespace havers::io
