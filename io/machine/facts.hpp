// What the lines above the table tell of the specimen.
#pragma once

#include <span>

#include "calib/experiment/raw_test.hpp"
#include "io/machine/preview.hpp"

namespace havers::io {

/// Fills id, width, thickness, gauge length and area from key, value, unit lines. A size tells its
/// decimal mark itself, whatever the table uses. A size that `test` has stays. What cannot be used
/// is left out with a warning that names the line.
void read_facts(std::span<const PreviewRow> header, calib::RawTest& test);

}  // namespace havers::io
