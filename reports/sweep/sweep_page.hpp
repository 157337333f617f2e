// The page of one sweep, or of several with what they found.
#pragma once

#include <string>
#include <vector>

#include "calib/sweep/sweep.hpp"
#include "reports/pages.hpp"

namespace havers::reports {

/// One sweep of the page; holds references to the sweep and its results.
struct SweepReport {
  std::string id;  ///< Unique on the page, a word.
  const calib::Sweep& sweep;
  const calib::SweepResult& result;
};

/// HTML: the findings of all sweeps, then each sweep with its figures, laws and points.
std::string sweep_page(const std::string& title, const std::vector<SweepReport>& sweeps,
                       const calib::Provenance& provenance);

}  // namespace havers::reports
