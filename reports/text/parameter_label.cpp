#include "reports/text/parameter_label.hpp"

#include <fmt/format.h>

#include "calib/study/parameter.hpp"

namespace havers::reports {

std::string symbol_of(const std::string& parameter) {
  const std::size_t bracket = parameter.find('[');
  const calib::ParameterInfo* info = calib::find_parameter(parameter.substr(0, bracket));
  const std::string level =
      bracket == std::string::npos ? "" : fmt::format(" {}", parameter.substr(bracket));
  return info == nullptr ? level : std::string(info->symbol) + level;
}

std::string axis_label(const std::string& parameter) {
  const calib::ParameterInfo* info =
      calib::find_parameter(parameter.substr(0, parameter.find('[')));
  if (info == nullptr) return parameter;
  return info->unit.empty() ? symbol_of(parameter)
                            : fmt::format("{} ({})", symbol_of(parameter), info->unit);
}

}  // namespace havers::reports
