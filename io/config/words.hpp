// The words of input and output files for enumerations, in the order of their enumerators.
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "calib/fit/calibration.hpp"
#include "calib/study/study.hpp"
#include "sim/scene.hpp"

namespace havers::io {

template <std::size_t N>
using Words = std::array<std::string_view, N>;

constexpr Words<2> words(sim::Plane) {
  return {"stress", "strain"};
}
constexpr Words<3> words(sim::Distribution) {
  return {"uniform", "weibull", "lognormal"};
}
constexpr Words<2> words(sim::Lateral) {
  return {"periodic", "free"};
}
constexpr Words<2> words(sim::Start) {
  return {"uniform", "rest"};
}
constexpr Words<3> words(sim::Regime) {
  return {"auto", "dynamic", "quasi-static"};
}
constexpr Words<3> words(sim::ContactMethod) {
  return {"auto", "active-set", "gauss-seidel"};
}
constexpr Words<2> words(calib::Use) {
  return {"fit", "validate"};
}
constexpr Words<3> words(calib::Level) {
  return {"shared", "orientation", "specimen"};
}
constexpr Words<3> words(calib::ToScatter) {
  return {"window", "linear", "none"};
}
constexpr Words<2> words(calib::ToModulus) {
  return {"none", "power"};
}

constexpr Words<3> words(calib::Outcome) {
  return {"pass", "warn", "fail"};
}
constexpr Words<5> words(calib::CalibrationStatus) {
  return {"converged", "budget_spent", "all_failed", "nothing_to_fit", "cancelled"};
}

/// An enumeration that has words.
template <class E>
concept Worded = std::is_enum_v<E> && requires(E e) {
  words(e);
};

template <Worded E>
std::string_view word(E value) {
  return words(value).at(static_cast<std::size_t>(value));
}

}  // namespace havers::io
