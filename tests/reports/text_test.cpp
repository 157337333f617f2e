#include <gtest/gtest.h>

#include <limits>

#include "reports/text/base64.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Number, KeepsSignificantDigitsAndNotMore) {
  EXPECT_EQ(number(38.2149), "38.21");
  EXPECT_EQ(number(0.0041), "0.004100");
  EXPECT_EQ(number(123456.7), "123457");
  EXPECT_EQ(number(-2.5, 2), "−2.5");
  EXPECT_EQ(number(0.0), "0");
}

TEST(Number, CountsDigitsAfterRounding) {
  EXPECT_EQ(number(9.99996), "10.00");
}

TEST(Number, WritesPowersOfTenOnlyWhereTheyHelp) {
  EXPECT_EQ(number(3.214e-14, 3), "3.21\u00a0×\u00a010⁻¹⁴");
  EXPECT_EQ(number(1.5e9, 2), "1.5\u00a0×\u00a010⁹");
}

TEST(Number, IsADashWhereNothingIsKnown) {
  EXPECT_EQ(number(nan), "–");
  EXPECT_EQ(quantity(infinity, "MPa"), "–");
  EXPECT_EQ(interval(nan, 2.0), "–");
}

TEST(Typeset, WritesPowersOfTenInASentence) {
  EXPECT_EQ(typeset("Gauss-Seidel 1e-06, h = 5 ns"), "Gauss-Seidel 10⁻⁶, h = 5\u00a0ns");
  EXPECT_EQ(typeset("off by 6.1e-09 at 2e+12 Pa"),
            "off by 6.1\u00a0×\u00a010⁻⁹ at 2\u00a0×\u00a010¹²\u00a0Pa");
  EXPECT_EQ(typeset("the ends: 3 e, 3e"), "the ends: 3 e, 3e");
  EXPECT_EQ(typeset(""), "");
}

TEST(Setting, IsWrittenAsItWasChosen) {
  EXPECT_EQ(setting(0.33), "0.33");
  EXPECT_EQ(setting(13.0, "GPa"), "13\u00a0GPa");
  EXPECT_EQ(setting(nan, "GPa"), "–");
  EXPECT_EQ(setting(1e-8), "10⁻⁸");
  EXPECT_EQ(setting(-2.5e-9, "m"), "−2.5\u00a0×\u00a010⁻⁹\u00a0m");
}

TEST(Typeset, WritesTheNumbersOfASentenceAsAPageDoes) {
  EXPECT_EQ(typeset("alike (p = 3e-06), or -2.5e+07."),
            "alike (p = 3\u00a0×\u00a010⁻⁶), or −2.5\u00a0×\u00a010⁷.");
  EXPECT_EQ(typeset("p < 1e-6"), "p < 10⁻⁶");
  EXPECT_EQ(typeset("specimen 2e-20240501093000"), "specimen 2e-20240501093000");
  EXPECT_EQ(typeset("AICc is -21.7 (-3 before)"), "AICc is −21.7 (−3 before)");
}

TEST(Typeset, EndsNoLineBetweenANumberAndItsUnitOrError) {
  EXPECT_EQ(typeset("took 47 % of all, known to ± 1.9 % after 20 ns"),
            "took 47\u00a0% of all, known to ±\u00a01.9\u00a0% after 20\u00a0ns");
  EXPECT_EQ(typeset("1e-06 Pa, 3 µm, 12.5 GPa, 1000 1/s."),
            "10⁻⁶\u00a0Pa, 3\u00a0µm, 12.5\u00a0GPa, 1000\u00a01/s.");
  EXPECT_EQ(typeset("2 specimens, 3 mm2, 4 Papers"), "2 specimens, 3 mm2, 4 Papers");
}

TEST(Typeset, LeavesNamesAndWordsAsTheyAre) {
  for (const char* text : {"run-3.csv", "quasi-static", "2-fold", "sha 3e45", "a1e-6", "0 to 1"})
    EXPECT_EQ(typeset(text), text);
}

TEST(Typeset, WritesExponentsAndDegreesAsAPageDoes) {
  EXPECT_EQ(typeset("r^-0.23 × E^2 at 45 deg, -30 deg"), "r⁻⁰·²³ × E² at 45°, −30°");
  EXPECT_EQ(typeset("5 degrees, (1 − p)^m"), "5 degrees, (1 − p)^m");
}

TEST(ParameterLabel, GivesSymbolAndUnitOnce) {
  EXPECT_EQ(axis_label("young_GPa"), "E (GPa)");
  EXPECT_EQ(axis_label("head_tail_MPa[45 deg]"), "σ₁ [45°] (MPa)");
  EXPECT_EQ(axis_label("ratio"), "r");
}

TEST(ParameterLabel, WritesFormulasWithSymbols) {
  const std::vector<std::string> both{"ratio", "young_GPa[A1]", "young_GPa[A12]"};
  EXPECT_EQ(with_symbols("young_GPa[A12] × ratio^-0.2 is known", both),
            "E [A12] × r^-0.2 is known");
  EXPECT_EQ(with_symbols("set calibrate.bounds.ratio", both), "set calibrate.bounds.ratio");
  EXPECT_EQ(with_symbols("ratios of young_GPa", both), "ratios of young_GPa");
}

TEST(PlusMinus, ShowsTwoDigitsOfTheError) {
  EXPECT_EQ(plus_minus(13.1234, 0.0871), "13.123\u00a0±\u00a00.087");
  EXPECT_EQ(plus_minus(1234.6, 56.0), "1235\u00a0±\u00a056");
  EXPECT_EQ(plus_minus(0.3, 0.0996), "0.30\u00a0±\u00a00.10");
}

TEST(PlusMinus, LeavesOutAnErrorThatIsNotKnown) {
  EXPECT_EQ(plus_minus(13.1234, nan), "13.12");
  EXPECT_EQ(plus_minus(13.1234, 0.0), "13.12");
  EXPECT_EQ(plus_minus(13.1234, 2e-15), "13.12");
  EXPECT_EQ(plus_minus(nan, 0.1), "–");
}

TEST(Interval, HasNoMinusBeforeZero) {
  EXPECT_EQ(interval(-0.004, 0.9), "0.00 to 0.90");
  EXPECT_EQ(with_interval(-0.004, -0.9, 0.9, "%"), "0.0\u00a0% (−0.9 to 0.9)");
}

TEST(Interval, ShowsTwoDigitsOfItsWidth) {
  EXPECT_EQ(interval(12.9494, 13.2974), "12.95 to 13.30");
  EXPECT_EQ(interval(2.0, 2.0), "2.000 to 2.000");
}

TEST(WithInterval, GivesTheValueTheDecimalsOfItsInterval) {
  EXPECT_EQ(with_interval(-25.979, -26.015, -25.943, "%"), "−25.979\u00a0% (−26.015 to −25.943)");
  EXPECT_EQ(with_interval(12.9, 12.7, 13.3), "12.90 (12.70 to 13.30)");
  EXPECT_EQ(with_interval(1.0, nan, nan, "%"), "1.00\u00a0% (interval not known)");
  EXPECT_EQ(with_interval(nan, nan, nan, "%"), "–");
}

TEST(Chance, IsNeverZero) {
  EXPECT_EQ(chance(0.0134), "p = 0.013");
  EXPECT_EQ(chance(0.0), "p < 10⁻⁶");
}

TEST(Count, KnowsThePlural) {
  EXPECT_EQ(count(1, "pore"), "1 pore");
  EXPECT_EQ(count(0, "pore"), "0 pores");
}

TEST(Prefix, BringsTheNumberAboveOne) {
  EXPECT_EQ(prefix_for(4.2e-6).symbol, "µ");
  EXPECT_EQ(prefix_for(0.5).symbol, "m");
  EXPECT_EQ(prefix_for(0.0).factor, 1.0);
  EXPECT_EQ(prefixed(2e-8, "s"), "20.0\u00a0ns");
}

TEST(RoundDown, FindsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_down(7.5), 5.0);
  EXPECT_DOUBLE_EQ(round_down(0.0499), 0.02);
  EXPECT_DOUBLE_EQ(round_down(199.0), 100.0);
}

TEST(Plain, LeavesNothingThatEndsAStringOrALine) {
  EXPECT_EQ(plain("a'b\"c`d\\e\nEOD"), "a’b_c_d_e EOD");
  EXPECT_EQ(plain("Fémur A"), "Fémur A");
}

// The vectors of RFC 4648, section 10.
TEST(Base64, AgreesWithItsStandard) {
  const auto encode = [](std::string_view text) {
    return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace havers::reports
