// Bytes as text, for images inside a page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace havers::reports {

/// Base64 with padding (RFC 4648), without line breaks.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace havers::reports
