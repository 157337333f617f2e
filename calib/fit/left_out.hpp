// What the specimens do not tell and is left out of the fit: where it stays, and what it costs.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/fit/answer.hpp"
#include "calib/fit/trail.hpp"

namespace havers::calib {

/// What is left out before the search stays where the study has it, wherever the trail's best point
/// was looked for; not where simulations fail there.
void put_back(Trail& trail, const std::vector<LeftUnknown>& left);

/// Unknowns that turn out uninformed at the answer go back to where the study has them, unless the
/// specimens contradict that (F10): then what they do not tell would be wrong, and spoil what they
/// do.
void leave_out(Trail& trail, std::vector<LeftUnknown> left, Answer& answer);

/// What was asked for and left out may be wrong all the same: where the specimens contradict it
/// (F10), it is fitted along and stays there. Whether one was.
bool mend_left_out(Trail& trail, const Eigen::MatrixXd& jacobian, Answer& answer);

/// What the study asks for, and the specimens do not tell; what "auto" leaves out is as the study
/// says.
Active asked_and_left(const FitProblem& problem, const Answer& answer);

/// Slopes of what is fitted and, beside them, of what was asked for and left out: its value is a
/// choice too, and takes freedom from the residuals (F9), unless it cannot move them by one
/// standard deviation over all its bounds.
AskedSlopes with_left_out(Trail& trail, const Answer& answer, const Differences& fitted);

/// Of the answer's, slopes along what the specimens chose the values of: what is fitted, and what
/// was kept where the fit found it (F19).
Eigen::MatrixXd chosen_slopes(const Answer& answer);

}  // namespace havers::calib
