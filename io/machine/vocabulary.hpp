// What testing machines call things, in several languages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/machine/read_test.hpp"

namespace havers::io {

/// The quantity a column's name speaks of; `other` where it names none that is known.
Quantity quantity_of_name(std::string_view name);

/// Whether the name is that of an absolute position, which is no extension where there is another.
bool is_absolute(std::string_view name);

/// Whether the name is that of a result of a whole test: "Maximum load", "Tensile strength", ...
bool is_result(std::string_view name);

/// What a header line may tell of the specimen. A bare length is the gauge length where no line
/// speaks of a gauge.
enum class Fact { specimen_id, width, thickness, length, gauge_length, area };

/// The fact a header's key names: "Specimen ID", "Geometry : Width", "Largeur", ...
std::optional<Fact> fact_of_key(std::string_view key);

}  // namespace havers::io
