// What a calibration searches: one unknown per parameter and group of specimens that share its
// value.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/study/parameter.hpp"
#include "calib/study/study.hpp"

namespace havers::calib {

/// Values of all unknowns, in the scale of their search: logarithm or plain (F1).
using Point = Eigen::VectorXd;

/// Indices into a Point: the unknowns that a search may move. The others keep their value.
using Active = std::vector<Eigen::Index>;

/// One value to be found, of a parameter for a group of specimens.
struct Unknown {
  const ParameterInfo* info = nullptr;
  std::string label;                     ///< "ratio", "young_GPa[45 deg]", "young_GPa[A1]".
  double lower = 0.0, upper = 0.0;       ///< Bounds, in the scale of the search.
  std::pair<double, double> bounds{};    ///< The same as the study gives them. [info->unit]
  double start = 0.0;                    ///< The study's model, moved inside the bounds.
  std::vector<std::size_t> specimens{};  ///< Those it acts on.
  Level level = Level::shared;           ///< What these have in common.

  [[nodiscard]] double range() const { return upper - lower; }
};

/// A value in the parameter's unit to the scale of the search (F1), and back.
double to_search(const ParameterInfo& info, double value);
double from_search(const ParameterInfo& info, double position);

/// An unknown's value in its unit; at a bound the very one that the study gives, not its rounding
/// by the scale of the search.
double value_in_unit(const Unknown& unknown, double position);

/// The unknowns of a study, in the order of all_parameters().
std::vector<Unknown> unknowns_of(const Study& study);

/// Where every unknown has its start; and the middle of the bounds.
Point start_point(const std::vector<Unknown>& unknowns);
Point middle_point(const std::vector<Unknown>& unknowns);

/// The point moved inside the bounds.
Point inside_bounds(const std::vector<Unknown>& unknowns, Point point);

/// A specimen's value of a parameter, in its unit: of the unknown that acts on it; the mean over
/// the parameter's unknowns where none does (a specimen kept for validation); nothing if it is not
/// searched.
std::optional<double> value_at(const std::vector<Unknown>& unknowns, const Point& point,
                               const ParameterInfo& info, std::size_t specimen);

}  // namespace havers::calib
