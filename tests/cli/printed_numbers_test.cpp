// The numbers of a summary are those of the JSON, in the units that stand beside them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/printed.hpp"
#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::expect_numbers;
using test::line_with;
using test::printed;
using test::run_havers;

double number(const nlohmann::json& json, const char* key) {
  return json.at(key).get<double>();
}

TEST(PrintedNumbers, OfImportAreThoseOfItsJson) {
  const fs::path folder = test::folder_with_tests();
  const std::string out = run_havers(folder, "import made/B0.csv -o out").out;
  const auto json = nlohmann::json::parse(test::contents(folder / "out/import.json"));
  const auto at = [&](const char* key) { return number(json, key); };

  const std::string strength = line_with(out, "  strength");
  EXPECT_EQ(printed(strength).words,
            "strength # +- # MPa at a strain of # %, largest force # N on # mm2");
  expect_numbers(strength, {1e-6 * at("strength_Pa"), 1e-6 * at("strength_standard_error_Pa"),
                            100.0 * at("failure_strain"), at("max_force_N"), 1e6 * at("area_m2")});
  const std::string energy = line_with(out, "  energy");
  EXPECT_EQ(printed(energy).words, "energy to failure # MJ/m3, strain rate # 1/s");
  expect_numbers(energy, {1e-6 * at("energy_to_failure_J_per_m3"), at("strain_rate_per_s")});
  const std::string modulus = line_with(out, "  modulus");
  EXPECT_EQ(printed(modulus).words, "modulus # +- # GPa between strains of # and # %");
  expect_numbers(modulus, {1e-9 * at("modulus_Pa"), 1e-9 * at("modulus_standard_error_Pa"),
                           100.0 * at("window_low"), 100.0 * at("window_high")});
}

TEST(PrintedNumbers, OfASimulationAreThoseOfItsJson) {
  const fs::path folder = test::folder_with_scene();
  const std::string out = run_havers(folder, "simulate scene.toml -o out").out;
  const auto json = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  const auto at = [&](const char* key) { return number(json, key); };

  const std::string strength = line_with(out, "strength  ");
  EXPECT_EQ(printed(strength).words, "strength # MPa at a strain of # %");
  expect_numbers(strength, {1e-6 * at("strength_Pa"), 100.0 * at("failure_strain")});
  const std::string modulus = line_with(out, "modulus  ");
  EXPECT_EQ(printed(modulus).words, "modulus # GPa");
  expect_numbers(modulus, {1e-9 * at("modulus_Pa")});
  const auto joints =
      static_cast<double>(std::ranges::count(test::contents(folder / "out/joints.csv"), '\n') - 1);
  expect_numbers(line_with(out, "broken joints"),
                 {at("broken_joints"), joints, 100.0 * at("first_break_strain"),
                  at("end_fraction_used"), 0.3});
  const std::string time = line_with(out, "time  ");
  EXPECT_EQ(printed(time).words,
            "time # s for # events; energy defect #, residual #, penetration # m");
  expect_numbers(time, {at("wall_s"), at("steps"), at("energy_defect"), at("worst_residual"),
                        at("worst_penetration_m")});
}

TEST(PrintedNumbers, OfAFitAreThoseOfItsJson) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_tests();
  const auto answer = run_havers(folder, "fit made/study.toml -o out");
  EXPECT_EQ(answer.exit_code, 0);
  const auto json = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  ASSERT_EQ(json["parameters"].size(), 2U);
  for (const auto& parameter : json["parameters"]) {
    const auto name = parameter["name"].get<std::string>();
    const std::string line = line_with(answer.out, "  " + name + " ");
    EXPECT_EQ(printed(line).words, name + " # # % interval # to #");
    expect_numbers(
        line, {parameter["value"], 95.0, parameter["interval_95"][0], parameter["interval_95"][1]});
  }
  EXPECT_EQ(printed(line_with(answer.out, "specimens  ")).words,
            "specimens E [GPa] simulated sigma [MPa] simulated porosity scatter");
  ASSERT_EQ(json["specimens"].size(), 2U);
  for (const auto& specimen : json["specimens"]) {
    const auto& simulated = specimen["simulated"];
    const std::string line = line_with(answer.out, "  " + specimen["id"].get<std::string>() + " ");
    EXPECT_EQ(printed(line).words, specimen["id"].get<std::string>() + " # # # # - #");
    expect_numbers(line, {1e-9 * number(specimen, "modulus_Pa"),
                          1e-9 * number(simulated["modulus_Pa"], "mean"),
                          1e-6 * number(specimen, "strength_Pa"),
                          1e-6 * number(simulated["strength_Pa"], "mean"), specimen["scatter"]});
  }
  const std::string last = line_with(answer.out, " s for a cost of ");
  EXPECT_EQ(printed(last).words, "# s for a cost of #: # simulations, # of them new, # failed");
  expect_numbers(last, {json["wall_s"], json["cost"], json["evaluations"], json["simulated"],
                        json["failed_simulations"]});
}

TEST(Fit, TakesItsSeedFromTheCommandLine) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_tests();
  const auto seeds = [&](const std::string& option) {
    const auto answer = run_havers(folder,
                                   "fit made/study.toml -o out --force --json --set "
                                   "calibrate.options.profiles=false" +
                                       option);
    const auto result = nlohmann::json::parse(answer.out);
    std::vector<std::uint64_t> all;
    for (const auto& specimen : result["specimens"])
      for (const auto& replicate : specimen["replicates"]) all.push_back(replicate["seed"]);
    return all;
  };
  const auto usual = seeds("");
  ASSERT_EQ(usual.size(), 4U);
  EXPECT_EQ(seeds(" --seed 1"), usual);
  EXPECT_NE(seeds(" --seed 2"), usual);
}

}  // namespace
}  // namespace havers
