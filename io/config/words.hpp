// The words of input and output files for enumerations, in the order of their enumerators.
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

/// None, unless given below.
template <class E>
inline constexpr Words<0> words{};

template <>
inline constexpr Words<2> words<sim::Plane>{"stress", "strain"};
template <>
inline constexpr Words<3> words<sim::Distribution>{"uniform", "weibull", "lognormal"};
template <>
inline constexpr Words<2> words<sim::Lateral>{"periodic", "free"};
template <>
inline constexpr Words<2> words<sim::Start>{"uniform", "rest"};
template <>
inline constexpr Words<3> words<sim::Regime>{"auto", "dynamic", "quasi-static"};
template <>
inline constexpr Words<3> words<sim::ContactMethod>{"auto", "active-set", "gauss-seidel"};
template <>
inline constexpr Words<2> words<calib::Use>{"fit", "validate"};
template <>
inline constexpr Words<3> words<calib::Level>{"shared", "orientation", "specimen"};
template <>
inline constexpr Words<5> words<calib::GlobalSearch>{"starts", "crs2", "direct", "mlsl", "esch"};
template <>
inline constexpr Words<4> words<calib::LocalSearch>{"auto", "bobyqa", "sbplx", "cobyla"};
template <>
inline constexpr Words<3> words<calib::ToScatter>{"window", "linear", "none"};
template <>
inline constexpr Words<2> words<calib::ToModulus>{"none", "power"};
template <>
inline constexpr Words<3> words<Pores>{"found", "dark", "bright"};
template <>
inline constexpr Words<3> words<Threshold>{"half-maximum", "otsu", "sauvola"};
template <>
inline constexpr Words<3> words<calib::Outcome>{"pass", "warn", "fail"};
template <>
inline constexpr Words<5> words<calib::CalibrationStatus>{"converged", "budget_spent", "all_failed",
                                                          "nothing_to_fit", "cancelled"};

/// An enumeration that has words.
template <class E>
concept Worded = !words<E>.empty();

template <Worded E>
std::string_view word(E value) {
  return words<E>.at(static_cast<std::size_t>(value));
}

}  // namespace havers::io
