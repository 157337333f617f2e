// A test with the gauge of a second logger.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/clocks.hpp"
#include "calib/experiment/measured_test.hpp"

namespace havers::calib {

/// The test on the machine's clock, and how the clocks were matched.
struct JoinedTest {
  RawTest test;
  ClockFit clocks;
  std::vector<std::string> problems;
};

/// Matches the clocks by the test's force (or stress or extension) and the logger's force, strain
/// or volts; then the strain of the test is the logger's, at the machine's rows that the logger saw
/// too, with its mark of the crosshead's. The logger's extension is divided by the machine's gauge
/// length, with a warning: by one of its own io has made a strain of it. Volts become strain by a
/// line fitted to the test's own strain, a force in volts becomes one by the logger's (X19). Both
/// records are cleaned before, and a load that is written negative is turned (X11), (X12), (X22);
/// the joined test lists it.
JoinedTest join_logger(const RawTest& machine, const RawTest& recorded,
                       const ReductionOptions& options);

}  // namespace havers::calib
