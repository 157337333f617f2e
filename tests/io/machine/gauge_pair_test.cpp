// Two gauges on the faces of a bar of 14 GPa, 8 mm², which bends by 20 % of its strain.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "calib/experiment/measured_test.hpp"
#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

using testing::HasSubstr;
using Face = std::function<std::string(int row, double strain)>;

constexpr int row_count = 200;
const std::string two_faces = "Time (s),Load (N),SG1 (µε),SG2 (µε)\n";

std::string bends(double part, double strain) {
  return fmt::format("{:.3f}", 1e6 * (1.0 + part) * strain);
}
std::string on_front(int, double strain) {
  return bends(0.2, strain);
}
std::string on_back(int, double strain) {
  return bends(-0.2, strain);
}

TestFile test_of(const Face& a, const Face& b, const std::string& names = two_faces) {
  std::string text = "Width,4,mm\nThickness,2,mm\nGauge length,25,mm\n" + names;
  for (int row = 0; row < row_count; ++row) {
    const double strain = 3e-5 * row;
    text += fmt::format("{},{:.4f},{},{}\n", 0.1 * row, 14e9 * 8e-6 * strain, a(row, strain),
                        b(row, strain));
  }
  return test::read_content(text);
}

double modulus_GPa(const TestFile& file) {
  const calib::Reduction reduction = calib::reduce_test(file.test, {});
  EXPECT_TRUE(reduction.problems.empty());
  return 1e-9 * reduction.test.modulus;
}

TEST(GaugePair, IsTheirMeanWhichBendingDoesNotMove) {
  for (const char* names :
       {"Strain gauge left (µε),Strain gauge right (µε)", "CH1 (µε),CH2 (µε)",
        "DMS 1 vorn (µm/m),DMS 2 hinten (µm/m)", "Strain 1 (µε),Strain 2 (µε)"}) {
    const TestFile file = test_of(on_front, on_back, fmt::format("Time (s),Load (N),{}\n", names));
    EXPECT_NEAR(modulus_GPa(file), 14.0, 1e-3) << names;
  }
  EXPECT_THAT(test_of(on_front, on_back).test.warnings,
              testing::Contains("columns \"SG1\" and \"SG2\" both hold strain: their mean is used, "
                                "which bending does not move; it adds 20 % to the strain at a face "
                                "(strain = 3 in [specimen.columns] or 4 takes one alone)"));
}

TEST(GaugePair, IsTheOneThatWorks) {
  const Face still = [](int, double) { return "17.5"; };
  const Face absent = [](int, double) { return "-"; };
  const Face falls_off = [](int row, double strain) {
    return row < row_count / 3 ? on_front(row, strain) : "4.0";
  };
  const Face opens = [](int row, double strain) {
    return row < row_count / 3 ? on_front(row, strain) : "99999";
  };
  for (const Face& failed : {still, absent, falls_off, opens}) {
    const TestFile first = test_of(failed, on_back), second = test_of(on_back, failed);
    EXPECT_NEAR(modulus_GPa(first), 14.0 / 0.8, 1e-3);
    EXPECT_NEAR(modulus_GPa(second), 14.0 / 0.8, 1e-3);
    EXPECT_THAT(first.test.warnings, testing::Contains(HasSubstr("and \"SG2\" alone is used")));
    EXPECT_THAT(second.test.warnings, testing::Contains(HasSubstr("and \"SG1\" alone is used")));
  }
}

// Across the load, of a rosette, or of another bar.
TEST(GaugePair, IsTheFirstWhereTheyAreNotOnTwoFaces) {
  const Face across = [](int, double strain) { return bends(-1.3, strain); };
  const TestFile file = test_of([](int, double strain) { return bends(0.0, strain); }, across);
  EXPECT_NEAR(modulus_GPa(file), 14.0, 1e-3);
  EXPECT_THAT(file.test.warnings,
              testing::Contains(HasSubstr("do not both stretch, and \"SG1\" is used")));
  for (const char* names : {"SG1 (µε),SG2 (µε),SG3 (µε)\n0,1,1,2,3\n1,2,11,22,33\n",
                            "SG1 (µε),SG2 (µε),Load 2 (N)\n0,1,1,2,3\n1,2,11,22,33\n"}) {
    const TestFile more = test::read_content(std::string("Time (s),Load 1 (N),") + names);
    EXPECT_DOUBLE_EQ(more.test.strain.at(1), 11e-6) << names;
    EXPECT_THAT(more.test.warnings, testing::Contains(HasSubstr("\"SG1\" is used (strain = 4")));
  }
}

}  // namespace
}  // namespace havers::io
