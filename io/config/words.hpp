// The words of input and output files for enumerations, in the order of their enumerators: the
// place of a word is the number of its enumerator. A new enumerator needs its word here.
#pragma once

#include <array>
#include <string_view>

#include "calib/fit/calibration.hpp"
#include "calib/study/study.hpp"
#include "io/images/measure_section.hpp"
#include "sim/scene.hpp"

namespace havers::io {

template <std::size_t N>
using Words = std::array<std::string_view, N>;

/// An enumeration has no words unless they are given below or, for sweeps, in
/// io/sweep/sweep_keys.hpp.
template <class E>
inline constexpr Words<0> words{};

template <>
inline constexpr Words<2> words<sim::Plane>{"stress", "strain"};  ///< material.plane
/// joints.distribution
template <>
inline constexpr Words<3> words<sim::Distribution>{"uniform", "weibull", "lognormal"};
template <>
inline constexpr Words<2> words<sim::Lateral>{"periodic", "free"};  ///< loading.lateral
template <>
inline constexpr Words<2> words<sim::Start>{"uniform", "rest"};  ///< loading.start
template <>
inline constexpr Words<3> words<sim::Regime>{"auto", "dynamic", "quasi-static"};  ///< solver.regime
/// solver.contact
template <>
inline constexpr Words<3> words<sim::ContactMethod>{"auto", "active-set", "gauss-seidel"};
template <>
inline constexpr Words<2> words<calib::Use>{"fit", "validate"};  ///< specimen.use
/// calibrate.level
template <>
inline constexpr Words<3> words<calib::Level>{"shared", "orientation", "specimen"};
/// calibrate.options.global
template <>
inline constexpr Words<5> words<calib::GlobalSearch>{"starts", "crs2", "direct", "mlsl", "esch"};
/// calibrate.options.local
template <>
inline constexpr Words<4> words<calib::LocalSearch>{"auto", "bobyqa", "sbplx", "cobyla"};
/// porosity.to_scatter
template <>
inline constexpr Words<3> words<calib::ToScatter>{"window", "linear", "none"};
template <>
inline constexpr Words<2> words<calib::ToModulus>{"none", "power"};  ///< porosity.to_modulus
template <>
inline constexpr Words<3> words<Pores>{"found", "dark", "bright"};  ///< sections.pores
/// sections.threshold
template <>
inline constexpr Words<3> words<Threshold>{"half-maximum", "otsu", "sauvola"};
/// Of a check in result.json's `verdict`.
template <>
inline constexpr Words<3> words<calib::Outcome>{"pass", "warn", "fail"};
/// `status` in the result.json of a fit.
template <>
inline constexpr Words<5> words<calib::CalibrationStatus>{"converged", "budget_spent", "all_failed",
                                                          "nothing_to_fit", "cancelled"};

/// An enumeration that has words.
template <class E>
concept Worded = !words<E>.empty();

/// The word of a value. @throws std::out_of_range for a value without one.
template <Worded E>
std::string_view word(E value) {
  return words<E>.at(static_cast<std::size_t>(value));
}

}  // namespace havers::io
