// What sweeps found, as the page tells it: a table, and the sentence above it.
#pragma once

#include <string>
#include <vector>

#include "reports/pages/page.hpp"
#include "reports/sweep/sweep_page.hpp"

namespace havers::reports {

/// A finding and the sweep that it was found in; both must live longer than the row.
struct FindingRow {
  const calib::Finding* finding;
  const calib::Sweep* sweep;
};

/// All findings by id, in the order of sweeps within one.
std::vector<FindingRow> findings_of(const std::vector<SweepReport>& sweeps);

/// The rows of the table in the template "sweep".
mstch::array finding_rows(const std::vector<FindingRow>& rows);

/// Which ids hold, their rows all agreeing; which are contradicted, all disagreeing; the rest is
/// undecided or differs by row. Precondition: there are rows.
std::string findings_sentence(const std::vector<FindingRow>& rows);

}  // namespace havers::reports
