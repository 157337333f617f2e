// What a file's header calls the facts of a specimen, in several languages.
#pragma once

#include <optional>
#include <string_view>

namespace havers::io {

/// What a header line may tell of the specimen. A number is its name where it has no other; a bare
/// length is the gauge length where no line speaks of a gauge; a diameter tells the area.
enum class Fact {
  specimen_id,
  specimen_number,
  width,
  thickness,
  diameter,
  length,
  gauge_length,
  extensometer_length,
  area
};

/// The fact that a header's key names: "Specimen ID", "Geometry : Width", "Largeur", ... Upper
/// case, and colons and blanks at the end, make no difference. Nothing where the key names no fact.
std::optional<Fact> fact_of_key(std::string_view key);

/// The specimen's name in a heading: "4" of "Specimen 4" and "Probe Nr. 4"; empty where there is
/// none. A name is a single word of two bytes at most, or one with a digit: "Test report" has none.
std::string_view name_in_heading(std::string_view heading);

}  // namespace havers::io
