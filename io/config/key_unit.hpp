// The unit in a key's name: the one place where numbers of files become SI and SI becomes numbers
// of files.
#pragma once

#include <numbers>

namespace havers::io {

/// SI value = value · times / over. Two whole factors instead of one, so that 100 µm is exactly
/// 1e-4 m.
struct KeyUnit {
  double times = 1.0, over = 1.0;
};

/// The unit that a key's ending names: "_mm".
inline constexpr KeyUnit millimetre{1.0, 1e3};
inline constexpr KeyUnit micrometre{1.0, 1e6};                 ///< _um
inline constexpr KeyUnit square_micrometre{1.0, 1e12};         ///< _um2
inline constexpr KeyUnit megapascal{1e6, 1.0};                 ///< _MPa
inline constexpr KeyUnit gigapascal{1e9, 1.0};                 ///< _GPa
inline constexpr KeyUnit millimetre_per_minute{1.0, 6e4};      ///< _mm_per_min, to m/s
inline constexpr KeyUnit millimetre_per_kilonewton{1.0, 1e6};  ///< _mm_per_kN, to m/N
inline constexpr KeyUnit degree{std::numbers::pi, 180.0};      ///< _deg, to rad

/// The value in SI units; rounded once where one of the factors is 1.
constexpr double to_si(double value, KeyUnit unit) {
  return value * unit.times / unit.over;
}

/// The shortest value that `to_si` takes back to `si`, where there is one; else the nearest.
double from_si(double si, KeyUnit unit);

}  // namespace havers::io
