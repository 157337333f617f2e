// Keys as a reader of the page knows them.
#pragma once

#include <string>

namespace havers::reports {

/// "scatter d" for "joints.scatter", "angle θ (°)"; what is behind the dot for keys without a
/// symbol.
std::string name_of_key(const std::string& key);

/// "45°", "3": a value of a key.
std::string with_unit(const std::string& key, const std::string& value);

/// "θ = 45°", "ratio r = 3": a key at a value, the unit behind it; blanks do not break.
std::string place(const std::string& key, const std::string& value);

}  // namespace havers::reports
