// What testing machines call things, in several languages.
#pragma once

#include <optional>
#include <string_view>

#include "io/machine/read_test.hpp"
#include "io/machine/units.hpp"

namespace havers::io {

/// The quantity a column's name speaks of; `other` where it names none that is known.
Quantity quantity_of_name(std::string_view name);

/// Whether the name is that of what a test does not measure: a command, a peak so far, a strain
/// across the load.
bool is_no_reading(std::string_view name);

/// Whether the name speaks of a sensor of its own: a gauge, an extensometer, a load cell.
bool is_of_sensor(std::string_view name);

/// Whether two names are those of sensors of one kind, or differ in digits only: "SG1" and "SG2",
/// "Gauge left" and "Gauge right".
bool are_alike(std::string_view one, std::string_view other);

/// Whether the name says that the column counts compression: "Compressive load", "Druckkraft".
bool counts_compression(std::string_view name);

/// Whether a column of that name and unit holds a strain of the crosshead: "Strain (Displacement)",
/// an "Extension" in percent.
bool is_crosshead_strain(std::string_view name, std::optional<Dimension> unit);

/// Why a column is taken only where no other holds its quantity: an absolute position, a strain of
/// the crosshead, a true strain. Empty for most.
std::string_view doubt_of(std::string_view name, std::optional<Dimension> unit);

/// Whether the name is that of a result of a whole test: "Maximum load", "Tensile strength", ...
bool is_result(std::string_view name);

}  // namespace havers::io
