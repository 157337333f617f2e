// A test as INSTRON's Bluehill writes its raw data: key,"value",unit lines, a blank line, names,
// units in round brackets, every number in quotes with grouped thousands.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <vector>

#include "io/machine/read_test.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {
namespace {

// Bluehill groups thousands: "1,004.80328".
struct Thousands : std::numpunct<char> {
  [[nodiscard]] char do_thousands_sep() const override { return ','; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

struct WrittenColumn {
  const char* name;
  const char* unit;
  const std::vector<double>& values;
  double per_unit;  // SI to the column's unit
  int decimals;
};

std::string quoted(const std::locale& locale, double value, int decimals) {
  return fmt::format(locale, "\"{:.{}Lf}\"", value, decimals);
}

// Sizes that are not known have no line.
std::string header(const calib::RawTest& test, const std::locale& locale) {
  std::string text;
  const auto size = [&](const char* key, const std::optional<double>& value) {
    if (value) text += fmt::format("{},{},mm\r\n", key, quoted(locale, *value * 1e3, 5));
  };
  size("Length", test.gauge_length);
  text += fmt::format("Specimen ID,\"{}\"\r\n", test.specimen_id);
  size("Thickness", test.thickness);
  size("Width", test.width);
  return text + "\r\n";
}

// Five, or for a fast test so many that its rows keep different times: two digits of a step.
int decimals_of(const std::vector<double>& time) {
  constexpr int usual = 5, of_a_step = 2;
  if (time.size() < 2 || !(time[1] > time[0])) return usual;
  return std::max(usual, of_a_step + static_cast<int>(std::ceil(-std::log10(time[1] - time[0]))));
}

std::vector<WrittenColumn> columns_of(const calib::RawTest& test) {
  std::vector<WrittenColumn> columns;
  for (const WrittenColumn& column : {
           WrittenColumn{"Time", "(s)", test.time, 1.0, decimals_of(test.time)},
           WrittenColumn{"Extension", "(mm)", test.extension, 1e3, 5},
           WrittenColumn{"Load", "(N)", test.force, 1.0, 5},
           WrittenColumn{"Tensile strain (Strain 1)", "(%)", test.strain, 1e2, 5},
           WrittenColumn{"Tensile stress", "(MPa)", test.stress, 1e-6, 4},
       })
    if (!column.values.empty()) columns.push_back(column);
  return columns;
}

}  // namespace

void write_bluehill(const std::filesystem::path& file, const calib::RawTest& test) {
  // The locale deletes its facet.
  const std::locale locale(std::locale::classic(), new Thousands);
  const std::vector<WrittenColumn> columns = columns_of(test);
  std::string text = header(test, locale);
  const auto row = [&](const auto& cell_of) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) text += ',';
      text += cell_of(columns[i]);
    }
    text += "\r\n";
  };
  row([](const WrittenColumn& column) { return column.name; });
  row([](const WrittenColumn& column) { return column.unit; });
  for (std::size_t i = 0; i < test.rows(); ++i)
    row([&](const WrittenColumn& column) {
      return quoted(locale, column.values[i] * column.per_unit, column.decimals);
    });

  write_file(file, text);
}

}  // namespace havers::io
