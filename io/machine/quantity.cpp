#include "io/machine/quantity.hpp"

#include <array>

namespace havers::io {

// The rows are in the order of Quantity.
const QuantityInfo& info_of(Quantity quantity) {
  using calib::RawTest;
  static constexpr std::array<QuantityInfo, 8> infos{{
      {"time", &RawTest::time, Dimension::time, "s", "s, ms, us, min or h"},
      {"force", &RawTest::force, Dimension::force, "N",
       "N, kN, lbf, kgf, V, or a factor such as 500 N/V"},
      {"extension", &RawTest::extension, Dimension::length, "mm", "mm, um, m or in"},
      {"strain", &RawTest::strain, Dimension::strain, "mm/mm",
       "%, mm/mm, ustrain, mm, V, or a factor such as 0.01 mm/V"},
      {"stress", &RawTest::stress, Dimension::stress, "MPa", "MPa, Pa, GPa or psi"},
      {"volts", &RawTest::volts, Dimension::voltage, "V", ""},
      {"load volts", &RawTest::load_volts, Dimension::voltage, "V", ""},
      {"other", nullptr, {}, "", ""},
  }};
  return infos.at(static_cast<std::size_t>(quantity));
}

std::string to_string(Quantity quantity) {
  return std::string(info_of(quantity).name);
}

bool fits(Quantity quantity, Dimension dimension) {
  return info_of(quantity).dimension == dimension ||
         (quantity == Quantity::strain && dimension == Dimension::length);
}

std::optional<Dimension> dimension_of(const Column& column) {
  const std::optional<Unit> unit = find_unit(column.unit);
  return unit ? std::optional(unit->dimension) : std::nullopt;
}

}  // namespace havers::io
