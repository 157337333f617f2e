#include "io/config/reduction_table.hpp"

#include <fmt/format.h>

#include "io/config/study_keys.hpp"

namespace havers::io {

void read_reduction(TableReader table, calib::ReductionOptions& options) {
  keys(table, options);
  const auto require = [&](bool holds, std::string_view key, double value, std::string_view rule) {
    if (!holds) table.complain(key, fmt::format("is {:g}, must be {}", value, rule));
  };
  // Of two that do not rise the one that the user gave is wrong.
  const bool rises = options.window_low < options.window_high;
  const bool high_is_given = table.has("window_high");
  require(options.window_low >= 0.0 && (rises || high_is_given), "window_low", options.window_low,
          "0 or more and below window_high");
  require(options.window_high <= 1.0 && (rises || !high_is_given), "window_high",
          options.window_high, "above window_low and at most 1");
  require(options.break_part > 0.0 && options.break_part < 1.0, "break_part", options.break_part,
          "between 0 and 1");
  require(options.straightness >= 0.0, "straightness", options.straightness, "0 or more");
  require(options.machine_compliance >= 0.0, "machine_compliance_mm_per_kN",
          from_si(options.machine_compliance, millimetre_per_kilonewton), "0 or more");
  require(options.largest_modulus_error > 0.0, "largest_modulus_error",
          options.largest_modulus_error, "above 0");
  require(options.largest_noise > 0.0, "largest_noise", options.largest_noise, "above 0");
}

}  // namespace havers::io
