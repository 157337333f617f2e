#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "io/config/key_unit.hpp"
#include "io/config/read_scene.hpp"
#include "io/results/result_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace havers::io {
namespace {

// No field has its default and no number is round, so that nothing comes back by chance.
sim::Scene unusual_scene() {
  sim::Scene scene;
  scene.assembly = {.layers = 7,
                    .fibres = 5,
                    .fibre_length = to_si(123.456789, micrometre),
                    .fibre_height = to_si(7.1, micrometre),
                    .orientation = to_si(33.3, degree)};
  scene.material = {.young = to_si(13.123456789012345, gigapascal),
                    .poisson = 1.0 / 3.0,
                    .density = 1987.6,
                    .plane = sim::Plane::strain,
                    .viscosity = 1e-7 / 3.0};
  scene.joints.head_tail = to_si(52.41, megapascal);
  scene.joints.flank = to_si(9.87654321, megapascal);
  scene.joints.head_tail_shear = to_si(33.3, megapascal);
  scene.joints.flank_tension = to_si(21.7, megapascal);
  scene.joints.scatter = 0.123;
  scene.joints.distribution = sim::Distribution::lognormal;
  scene.joints.friction = 0.17;
  scene.joints.reinforced_boundary = true;
  scene.joints.seed = 12345678901234567U;
  scene.loading = {.strain_rate = 3.3e-4,
                   .lateral = sim::Lateral::free,
                   .start = sim::Start::rest,
                   .max_strain = 0.031,
                   .end_fraction = 0.29};
  scene.solver = {.regime = sim::Regime::dynamic,
                  .step = 1.7e-6,
                  .contact = sim::ContactMethod::active_set,
                  .tolerance = 3e-9,
                  .max_iterations = 321,
                  .leave_out = false};
  return scene;
}

void expect_same(const sim::Scene& a, const sim::Scene& b) {
  EXPECT_EQ(a.assembly.layers, b.assembly.layers);
  EXPECT_EQ(a.assembly.fibres, b.assembly.fibres);
  EXPECT_EQ(a.assembly.fibre_length, b.assembly.fibre_length);
  EXPECT_EQ(a.assembly.fibre_height, b.assembly.fibre_height);
  EXPECT_EQ(a.assembly.orientation, b.assembly.orientation);
  EXPECT_EQ(a.material.young, b.material.young);
  EXPECT_EQ(a.material.poisson, b.material.poisson);
  EXPECT_EQ(a.material.density, b.material.density);
  EXPECT_EQ(a.material.plane, b.material.plane);
  EXPECT_EQ(a.material.viscosity, b.material.viscosity);
  EXPECT_EQ(a.joints.head_tail, b.joints.head_tail);
  EXPECT_EQ(a.joints.flank, b.joints.flank);
  EXPECT_EQ(a.joints.head_tail_shear, b.joints.head_tail_shear);
  EXPECT_EQ(a.joints.flank_tension, b.joints.flank_tension);
  EXPECT_EQ(a.joints.scatter, b.joints.scatter);
  EXPECT_EQ(a.joints.distribution, b.joints.distribution);
  EXPECT_EQ(a.joints.friction, b.joints.friction);
  EXPECT_EQ(a.joints.reinforced_boundary, b.joints.reinforced_boundary);
  EXPECT_EQ(a.joints.seed, b.joints.seed);
  EXPECT_EQ(a.loading.strain_rate, b.loading.strain_rate);
  EXPECT_EQ(a.loading.lateral, b.loading.lateral);
  EXPECT_EQ(a.loading.start, b.loading.start);
  EXPECT_EQ(a.loading.max_strain, b.loading.max_strain);
  EXPECT_EQ(a.loading.end_fraction, b.loading.end_fraction);
  EXPECT_EQ(a.solver.regime, b.solver.regime);
  EXPECT_EQ(a.solver.step, b.solver.step);
  EXPECT_EQ(a.solver.contact, b.solver.contact);
  EXPECT_EQ(a.solver.tolerance, b.solver.tolerance);
  EXPECT_EQ(a.solver.max_iterations, b.solver.max_iterations);
  EXPECT_EQ(a.solver.leave_out, b.solver.leave_out);
}

TEST(SceneToml, IsReadBackToTheSameBits) {
  const test::ScratchFolder folder;
  for (const sim::Scene& scene : {unusual_scene(), sim::Scene{}}) {
    const auto file = folder.write("scene.toml", scene_toml(scene));
    expect_same(read_scene(file).scene, scene);
  }
}

TEST(SceneJson, UsesTheKeysAndUnitsOfASceneFile) {
  const nlohmann::json json = scene_json(sim::Scene{});
  EXPECT_EQ(json["assembly"]["fibre_length_um"], 100.0);
  EXPECT_EQ(json["assembly"]["layers"], 30);
  EXPECT_EQ(json["material"]["young_GPa"], 13.0);
  EXPECT_EQ(json["material"]["plane"], "stress");
  EXPECT_EQ(json["joints"]["head_tail_MPa"], 50.0);
  EXPECT_EQ(json["loading"]["lateral"], "periodic");
  EXPECT_EQ(json["solver"]["regime"], "auto");
  EXPECT_FALSE(json["solver"].contains("step_s"));  // omitted: chosen, and said
  EXPECT_EQ(json["joints"]["reinforced_boundary"], true);
}

TEST(SceneJson, NamesTheFileOfThresholdsThatWereGivenJointByJoint) {
  sim::Scene scene;
  scene.joints.thresholds.resize(3);
  EXPECT_EQ(scene_json(scene)["joints"]["thresholds_file"], "joints.csv");
}

}  // namespace
}  // namespace havers::io
