#include <gmock/gmock.h>

#include <numbers>

#include "reports/pages.hpp"
#include "tests/support/results.hpp"

namespace havers::reports {
namespace {

using testing::HasSubstr;

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// The path data that follows a class, up to its closing quote.
std::string path_of(const std::string& svg, const std::string& name) {
  const std::string start = "<path class=\"" + name + "\" d=\"";
  const std::size_t at = svg.find(start) + start.size();
  return svg.substr(at, svg.find('"', at) - at);
}

TEST(FractureSvg, DrawsEveryFibreOnce) {
  for (const double theta : {0.0, std::numbers::pi / 4, 1.0}) {
    const auto assembly = sim::build_assembly({.layers = 6, .fibres = 4, .orientation = theta},
                                              sim::Lateral::periodic);
    const std::string svg = fracture_svg(assembly, test::simulation_sample(assembly));
    EXPECT_EQ(occurrences(path_of(svg, "fibre"), "Z"), assembly.bodies.size());
  }
}

TEST(FractureSvg, DrawsEveryBrokenJointByItsKind) {
  const auto assembly = sim::build_assembly({.layers = 6, .fibres = 4}, sim::Lateral::free);
  const auto simulation = test::simulation_sample(assembly);
  std::size_t head_tail = 0, flank = 0;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i)
    if (simulation.joints[i].broken)
      ++(assembly.joints[i].kind == sim::JointKind::flank ? flank : head_tail);
  ASSERT_GT(head_tail, 0U);
  ASSERT_GT(flank, 0U);
  const std::string svg = fracture_svg(assembly, simulation);
  EXPECT_EQ(occurrences(path_of(svg, "gap flank"), "Z"), flank);
  EXPECT_EQ(occurrences(path_of(svg, "gap head"), "Z"), head_tail);
  EXPECT_EQ(occurrences(path_of(svg, "head"), "z"), head_tail);
}

// Width 400 µm: a quarter of it is a bar of 100 µm. The right half moved by 1.6 µm: 3 % of the
// width are 7.5 times as much, and 5 is the round number below.
TEST(FractureSvg, StatesItsScaleAndItsMagnification) {
  const auto assembly = sim::build_assembly({.layers = 6, .fibres = 4}, sim::Lateral::free);
  const std::string svg = fracture_svg(assembly, test::simulation_sample(assembly));
  EXPECT_THAT(svg, HasSubstr(">100 µm<"));
  EXPECT_THAT(svg, HasSubstr(">displacements × 5<"));
}

TEST(FractureSvg, StaysSmall) {
  const auto assembly = sim::build_assembly({.layers = 30, .fibres = 21}, sim::Lateral::periodic);
  auto simulation = test::simulation_sample(assembly);
  for (auto& joint : simulation.joints) joint = {.threshold = {1.0, 1.0}, .broken = true};
  EXPECT_LT(fracture_svg(assembly, simulation).size(), 400'000U);
}

TEST(FractureSvg, SurvivesWhatIsMissing) {
  EXPECT_THAT(fracture_svg({}, {}), HasSubstr("the assembly is empty"));
  const auto assembly = sim::build_assembly({.layers = 2, .fibres = 2}, sim::Lateral::free);
  auto simulation = test::simulation_sample(assembly);
  simulation.displacements.setConstant(test::nan);
  EXPECT_THAT(fracture_svg(assembly, simulation), testing::Not(HasSubstr("nan")));
  EXPECT_THAT(fracture_svg(assembly, {}), testing::Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace havers::reports
