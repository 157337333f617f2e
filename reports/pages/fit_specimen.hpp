// One specimen on the page of a fit.
#pragma once

#include "reports/pages/page.hpp"

namespace havers::reports {

/// Its numbers, figures, tests and sections, for the templates "fit" and "specimen".
mstch::map specimen_content(const FitReport& report, std::size_t index);

}  // namespace havers::reports
