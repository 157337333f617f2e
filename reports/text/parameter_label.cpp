#include "reports/text/parameter_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "calib/study/parameter.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {

std::string symbol_of(const std::string& parameter) {
  const std::size_t bracket = parameter.find('[');
  const calib::ParameterInfo* info = calib::find_parameter(parameter.substr(0, bracket));
  const std::string level =
      bracket == std::string::npos ? "" : fmt::format(" {}", typeset(parameter.substr(bracket)));
  return info == nullptr ? level : std::string(info->symbol) + level;
}

std::string axis_label(const std::string& parameter) {
  const calib::ParameterInfo* info =
      calib::find_parameter(parameter.substr(0, parameter.find('[')));
  if (info == nullptr) return parameter;
  return info->unit.empty() ? symbol_of(parameter)
                            : fmt::format("{} ({})", symbol_of(parameter), info->unit);
}

std::string with_symbols(std::string sentence, std::vector<std::string> parameters) {
  std::ranges::sort(parameters, std::greater{}, &std::string::size);  // flank_MPa[A12] before [A1]
  const auto in_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (const std::string& parameter : parameters) {
    const std::string symbol = symbol_of(parameter);
    for (std::size_t at = 0; (at = sentence.find(parameter, at)) != std::string::npos;) {
      const std::size_t end = at + parameter.size();
      // Not inside a longer word or behind the dot of a longer key: that is another name.
      const bool alone = (at == 0 || (!in_word(sentence[at - 1]) && sentence[at - 1] != '.')) &&
                         (end == sentence.size() || !in_word(sentence[end]));
      if (alone) sentence.replace(at, parameter.size(), symbol);
      at += alone ? symbol.size() : parameter.size();
    }
  }
  return sentence;
}

}  // namespace havers::reports
