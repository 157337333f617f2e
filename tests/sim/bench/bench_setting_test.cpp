#include "sim/bench/bench_setting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/sim/bench/tiny_scene.hpp"

namespace havers::sim {
namespace {

TEST(BenchSetting, HasStepsWhereNothingBreaks) {
  Scene scene = test::tiny(Regime::quasi_static);
  scene.joints.head_tail = scene.joints.flank = 1e18;
  EXPECT_LE(base_step(scene) * scene.loading.strain_rate, 1e-2 * scene.loading.max_strain);
}

TEST(BenchSetting, RefinesTheMeshAtTheLongestAndTheShortestStep) {
  const Scene scene = test::tiny(Regime::dynamic);
  double longest = 0.0, shortest = base_step(scene);
  std::vector<double> with_finer_mesh;
  for (const BenchSetting& setting : bench_settings(scene)) {
    if (setting.refinement > 1) {
      ASSERT_TRUE(setting.step);
      with_finer_mesh.push_back(*setting.step);
    } else if (setting.step) {
      longest = std::max(longest, *setting.step);
      shortest = std::min(shortest, *setting.step);
    }
  }
  EXPECT_EQ(with_finer_mesh, (std::vector{longest, shortest, longest, shortest}));
}

TEST(BenchSetting, IsSaidInWords) {
  EXPECT_EQ(to_string({.step = 2e-8}), "active set, h = 20 ns, 8 triangles a fibre");
  EXPECT_EQ(to_string({.contact = ContactMethod::gauss_seidel, .tolerance = 1e-6, .step = 5e-9}),
            "Gauss-Seidel 1e-06, h = 5 ns, 8 triangles a fibre");
  EXPECT_EQ(to_string({.regime = Regime::quasi_static, .refinement = 4, .leave_out = false}),
            "quasi-static, nothing left out, 128 triangles a fibre");
  EXPECT_EQ(to_string({.step = 2e-8, .leave_out = false}),
            "active set, h = 20 ns, nothing left out, 8 triangles a fibre");
  EXPECT_EQ(to_string({.step = 4.577e-3}), "active set, h = 4.58 ms, 8 triangles a fibre");
  EXPECT_EQ(to_string({.step = 2e-12, .leap = true}),
            "active set, h = 2 ps from the first break on, 8 triangles a fibre");
  EXPECT_EQ(to_string({.step = 3.5e-6}), "active set, h = 3.5 µs, 8 triangles a fibre");
}

}  // namespace
}  // namespace havers::sim
