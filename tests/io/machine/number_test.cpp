#include "io/machine/number.hpp"

#include <gtest/gtest.h>

namespace havers::io {
namespace {

TEST(Number, ReadsWhatMachinesWrite) {
  EXPECT_EQ(parse_number("1.5").value, 1.5);
  EXPECT_EQ(parse_number("-0.0012").value, -0.0012);
  EXPECT_EQ(parse_number("+2").value, 2.0);
  EXPECT_EQ(parse_number("7.50E-05").value, 7.5e-5);
  EXPECT_EQ(parse_number("−3.5").value, -3.5);
  EXPECT_EQ(parse_number("7,5E-05", ',').value, 7.5e-5);
}

TEST(Number, TellsItsDecimalMarkWhereItStandsAlone) {
  for (const char* text : {"4.02", "4,02", "4.020", "4,020"})
    EXPECT_EQ(parse_lone_number(text).value, 4.02) << text;
  for (const char* text : {"1,004.5", "1.004,5", "1 004,5", "1'004.5"})
    EXPECT_EQ(parse_lone_number(text).value, 1004.5) << text;
  for (const char* text : {"1,004,000", "1.004.000", "1004000"})
    EXPECT_EQ(parse_lone_number(text).value, 1004000.0) << text;
  for (const char* text : {"4,02,1", "1.2,3.4", "4.02 mm", ","})
    EXPECT_EQ(parse_lone_number(text).fault, NumberFault::text) << text;
}

TEST(Number, ReadsEveryThousandsMark) {
  EXPECT_EQ(parse_number("1,004.80328").value, 1004.80328);
  EXPECT_EQ(parse_number("1,234,567").value, 1234567.0);
  EXPECT_EQ(parse_number("-12,345.5").value, -12345.5);
  EXPECT_EQ(parse_number("1 000.5").value, 1000.5);
  EXPECT_EQ(parse_number("1'000.5").value, 1000.5);
  EXPECT_EQ(parse_number("1’000.5").value, 1000.5);
  EXPECT_EQ(parse_number("1\xC2\xA0"
                         "000,34",
                         ',')
                .value,
            1000.34);
  EXPECT_EQ(parse_number("1\xE2\x80\xAF"
                         "000,34",
                         ',')
                .value,
            1000.34);
  EXPECT_EQ(parse_number("1.004,80328", ',').value, 1004.80328);
}

// A mark that groups nothing is a mistake, not a mark.
TEST(Number, RefusesGroupsThatAreNotOfThree) {
  for (const char* text : {"1,5", "1,0000", "0,123", "1234,567", "1,234,56", "1.2,345", ",5", "1,"})
    EXPECT_EQ(parse_number(text).fault, NumberFault::text) << text;
  EXPECT_EQ(parse_number("1.5", ',').fault, NumberFault::text);
}

TEST(Number, NamesEveryFault) {
  EXPECT_EQ(to_string(parse_number("1").fault), "is a number");
  EXPECT_EQ(to_string(parse_number("").fault), "is empty");
  EXPECT_EQ(to_string(parse_number("12a").fault), "is not a number");
  EXPECT_EQ(to_string(parse_number("NaN").fault), "is not a finite number");
  EXPECT_EQ(to_string(parse_number("-inf").fault), "is not a finite number");
  EXPECT_EQ(to_string(parse_number("1e999").fault), "is too large for a number");
}

TEST(Number, TakesWhatIsTooSmallAsZero) {
  const std::string zeros(330, '0');
  for (const std::string& text : {std::string("1e-999"), "0." + zeros + "1", "-." + zeros + "1"}) {
    EXPECT_EQ(parse_number(text).value, 0.0) << text;
    EXPECT_TRUE(is_number(text)) << text;
  }
  EXPECT_FALSE(is_number("0.1e999"));
  EXPECT_FALSE(is_number("1" + zeros + ".5"));
}

TEST(Number, RefusesACellLongerThanAnyNumber) {
  std::string no_number(1000, '1');
  no_number.push_back('x');
  EXPECT_FALSE(is_number(no_number));
  EXPECT_FALSE(is_number(std::string(1000, '1'), ','));
}

TEST(ParseClock, ReadsHoursMinutesAndSeconds) {
  for (const char* cell : {"10:00:01.25", "2026-05-01 10:00:01,25", "2026-05-01T10:00:01.25"})
    EXPECT_EQ(parse_clock(cell).value, 36001.25) << cell;
  EXPECT_EQ(parse_clock("2026-05-01T10:00:01.25Z").value, 36001.25);
  EXPECT_EQ(parse_number("+-5.2").fault, NumberFault::text);
  EXPECT_EQ(parse_clock("0:0:5").value, 5.0);
  EXPECT_EQ(parse_clock("12:01,5").value, 721.5);
  EXPECT_EQ(parse_clock("100:00:00").value, 360000.0);
  for (const char* cell : {"", ":", "::", "//", "10:00", "10:00:", "10:60:00", "10:00:60", "a:b:c",
                           "10:00:00:00", "-1:00:00"})
    EXPECT_EQ(parse_clock(cell).fault, NumberFault::text) << cell;
}

TEST(ParseClock, ReadsTheTwoHalvesOfADay) {
  EXPECT_EQ(parse_clock("10:00:01 AM").value, 36001.0);
  EXPECT_EQ(parse_clock("5/1/2026 1:00:01.5 pm").value, 46801.5);
  EXPECT_EQ(parse_clock("12:00:01AM").value, 1.0);
  EXPECT_EQ(parse_clock("12:00:01 PM").value, 43201.0);
  EXPECT_EQ(parse_clock("10:00:01 a.m.").value, 36001.0);
  EXPECT_EQ(parse_clock("1:00:01 p. m.").value, 46801.0);
  for (const char* cell : {"PM", " PM", "13:00:01 PM", "0:00:01 AM", "12:01.5 PM"})
    EXPECT_EQ(parse_clock(cell).fault, NumberFault::text) << cell;
}

}  // namespace
}  // namespace havers::io
