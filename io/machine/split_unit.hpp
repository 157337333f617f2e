// Units that are written in the name of a column.
#pragma once

#include <string>
#include <string_view>

namespace havers::io {

/// A name and the unit at its end: "Force [ kN ]" is "Force" and "kN". Without brackets, as in
/// "Load/kN", "Kraft in kN", "force_kN", "Load, kN", "Strain %", and in brackets that stand
/// elsewhere, as in "Force (lbf) A", it must be a unit that the named quantity or size can have.
/// Brackets at the end that look like a unit are one, known or not: "daX", "kN/s"; others belong to
/// the name, empty ones are dropped.
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit split_unit(std::string_view text);

}  // namespace havers::io
