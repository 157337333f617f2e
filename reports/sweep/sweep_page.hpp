// The page of one sweep, or of several with what they found.
#pragma once

#include <string>
#include <vector>

#include "calib/sweep/sweep.hpp"
#include "reports/pages.hpp"

namespace havers::reports {

/// One sweep of the page; refers to what was asked and what came of it.
struct SweepReport {
  std::string id;  ///< Unique on the page, a word.
  const calib::Sweep& sweep;
  const calib::SweepResult& result;
};

/// The findings of all sweeps first, then each with its figures, laws and points. HTML.
std::string sweep_page(const std::string& title, const std::vector<SweepReport>& sweeps,
                       const calib::Provenance& provenance);

}  // namespace havers::reports
