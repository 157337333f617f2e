// Every unit, in each of the places where a file may write it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

struct NamedChannel {
  const char* name;
  const char* unit;
  std::vector<double> calib::RawTest::*values;
};

constexpr std::array channels{NamedChannel{"Time", "s", &calib::RawTest::time},
                              NamedChannel{"Load", "N", &calib::RawTest::force},
                              NamedChannel{"Extension", "mm", &calib::RawTest::extension},
                              NamedChannel{"Strain", "%", &calib::RawTest::strain},
                              NamedChannel{"Stress", "MPa", &calib::RawTest::stress}};

// The names of all channels and their units, in a row of their own or behind the names.
std::string head_with(const char* channel, const std::string& unit, const char* form) {
  std::string names, units;
  for (const NamedChannel& column : channels) {
    const std::string written =
        fmt::format(fmt::runtime(form), column.name == channel ? unit : column.unit);
    names += column.name + (written.front() == ' ' ? written : "") + ",";
    units += written + ",";
  }
  return names + "\n" + (units.front() == ' ' ? "" : units + "\n");
}

void expect_unit(const NamedChannel& channel, const std::string& unit, double to_si) {
  for (const char* form : {" ({})", " [{}]", "({})", "{}"}) {
    const std::string head = head_with(channel.name, unit, form);
    SCOPED_TRACE(head);
    const calib::RawTest test =
        test::read_content(head + "0,1,2,3,4,\n1,2,3,4,5,\n2,3,4,5,6,\n").test;
    const std::vector<double>& values = test.*channel.values;
    ASSERT_EQ(values.size(), 3U);
    const auto first = static_cast<double>(&channel - channels.data());
    EXPECT_DOUBLE_EQ(values[2], (first + 2.0) * to_si);
  }
}

// What one is in SI units, from its definition.
constexpr double gravity = 9.80665, pound = 0.45359237 * gravity, inch = 0.0254;

TEST(EveryUnit, OfTimeAndForce) {
  for (const auto& [unit, to_si] : {std::pair{"s", 1.0}, {"sec", 1.0}, {"min", 60.0}, {"ms", 1e-3}})
    expect_unit(channels[0], unit, to_si);
  for (const auto& [unit, to_si] : {std::pair{"N", 1.0},
                                    {"kN", 1e3},
                                    {"lbf", pound},
                                    {"kgf", gravity},
                                    {"gf", 1e-3 * gravity},
                                    {"250 N/V", 250.0}})
    expect_unit(channels[1], unit, to_si);
}

TEST(EveryUnit, OfLengthAndStrain) {
  for (const auto& [unit, to_si] :
       {std::pair{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", inch}, {"um", 1e-6}, {"µm", 1e-6}})
    expect_unit(channels[2], unit, to_si);
  for (const auto& [unit, to_si] : {std::pair{"%", 1e-2},
                                    {"mm/mm", 1.0},
                                    {"µε", 1e-6},
                                    {"microstrain", 1e-6},
                                    {"0.002 mm/mm/V", 0.002}})
    expect_unit(channels[3], unit, to_si);
}

TEST(EveryUnit, OfStress) {
  for (const auto& [unit, to_si] : {std::pair{"MPa", 1e6},
                                    {"GPa", 1e9},
                                    {"Pa", 1.0},
                                    {"psi", pound / (inch * inch)},
                                    {"ksi", 1e3 * pound / (inch * inch)},
                                    {"kgf/mm²", 1e6 * gravity},
                                    {"kgf/mm2", 1e6 * gravity},
                                    {"N/mm²", 1e6}})
    expect_unit(channels[4], unit, to_si);
}

}  // namespace
}  // namespace havers::io
