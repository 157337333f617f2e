// Which unknowns the specimens inform, found from how the simulated outcome changes with them.
#pragma once

#include <string>
#include <vector>

#include "calib/fit/differences.hpp"

namespace havers::calib {

/// An unknown that is not fitted, and why.
struct LeftUnknown {
  Eigen::Index unknown = 0;
  std::string because;  ///< Half a sentence, after "left out because".
  /// The unknown with which only a combination is determined; −1 where nothing changes with it.
  Eigen::Index partner = -1;
  bool kept_where_found = false;  ///< For the study's value contradicts the specimens.

  /// The whole of why it stands where it does.
  [[nodiscard]] std::string reason() const;
};

/// Unknowns that the residuals' slopes do not inform (F10), the last of the documentation's order
/// first: what is left out of a pair that only shows together is the later of the two.
/// Precondition: !slopes.failed.
std::vector<LeftUnknown> uninformed(const FitProblem& problem, const Point& at, Active active,
                                    const Differences& slopes);

/// The active unknowns without those left out.
Active without(const Active& active, const std::vector<LeftUnknown>& left);

}  // namespace havers::calib
