#include "reports/text/base64.hpp"

#include <algorithm>
#include <string_view>

namespace havers::reports {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    // Three bytes make four letters of six bits. At the end missing bits are 0, missing letters
    // "=".
    const std::size_t taken = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < taken ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= taken ? alphabet[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

}  // namespace havers::reports
