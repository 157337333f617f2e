#pragma once

#include "calib/experiment/measured_test.hpp"
#include "io/config/table_reader.hpp"

namespace havers::io {

/// [reduction]; what is wrong is collected in the table's file.
void read_reduction(TableReader table, calib::ReductionOptions& options);

}  // namespace havers::io
