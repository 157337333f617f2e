// Common practice against ours, where the truth is drawn.
#include "io/images/section_benchmark.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/scratch_folder.hpp"

namespace havers::io {
namespace {

using calib::PorosityMethod;

TEST(SectionBenchmark, HoldsEveryPorosityUnderEveryHardship) {
  const std::vector<SectionCase> cases = section_cases(2);
  EXPECT_EQ(cases.size(), 7U * 2U * 4U * 2U);
  std::set<std::uint64_t> seeds;
  for (const SectionCase& one : cases) seeds.insert(one.drawing.seed);
  EXPECT_EQ(seeds.size(), cases.size());
}

// Ordinary cases in which the usual ways are badly wrong.
TEST(SectionBenchmark, ShowsWhereCommonPracticeFails) {
  const test::ScratchFolder folder;
  SectionDrawing drawing{.porosity = 0.0, .ring = true, .noise = 0.1};
  const auto empty = try_section({"empty", drawing}, folder.path() / "empty.png");
  EXPECT_GT(empty.error(PorosityMethod::naive), 0.4);
  EXPECT_GT(empty.error(PorosityMethod::otsu), 0.4);
  EXPECT_GT(empty.error(PorosityMethod::otsu_in_mask), 0.4);
  EXPECT_EQ(empty.error(PorosityMethod::ours), 0.0);

  drawing.porosity = 0.1;
  const auto porous = try_section({"porous", drawing}, folder.path() / "porous.png");
  EXPECT_LT(porous.error(PorosityMethod::otsu_in_mask), 0.02);
  EXPECT_LT(porous.error(PorosityMethod::ours), 0.003);
}

}  // namespace
}  // namespace havers::io
