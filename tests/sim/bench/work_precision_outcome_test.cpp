// What is said of a bench's rows.
#include <gtest/gtest.h>

#include "sim/bench/work_precision.hpp"
#include "tests/sim/bench/tiny_scene.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// A row whose runs all have every error known.
BenchRow judged_row(double cpu, double error, int trusted = 2) {
  const BenchSpread spread{error, error, error, 2};
  BenchRow row{.setting = {.step = 1e-9}, .runs = 2, .trusted = trusted};
  row.errors = {spread, spread, spread, spread, spread, spread};
  row.cpu = {cpu, cpu, cpu, 2};
  return row;
}

TEST(WorkPrecision, NamesTheCheapestSettingThatReachesATarget) {
  WorkPrecision study;
  study.rows = {judged_row(0.01, 0.0), judged_row(3.0, 1e-5),
                judged_row(1.0, 5e-5), judged_row(2.0, 1e-6),
                judged_row(0.5, 5e-3), judged_row(0.1, 1e-5, 1),  // not trusted
                judged_row(0.2, 1e-5), judged_row(0.3, 1e-5)};
  study.rows[6].setting.refinement = 2;
  for (BenchSpread BenchErrors::*error :
       {&BenchErrors::bonded_forces, &BenchErrors::strength, &BenchErrors::strength_without_ringing,
        &BenchErrors::failure_strain, &BenchErrors::curve})
    (study.rows[7].errors.*error).of = 1;  // not known for the other seed
  study.cheapest = cheapest_settings(study);
  ASSERT_EQ(study.cheapest.size(), 15U);
  for (const CheapestSetting& cheapest : study.cheapest)
    EXPECT_EQ(cheapest.row, cheapest.target == 1e-2 ? 4U : 2U) << cheapest.quantity;
  EXPECT_EQ(cheapest_for_failure(study), 2U);
  study.reference_errors.failure_strain.high = 2e-3;
  for (const CheapestSetting& cheapest : cheapest_settings(study))
    if (cheapest.quantity == "failure strain") {
      EXPECT_EQ(cheapest.row.has_value(), cheapest.target == 1e-2) << cheapest.target;
    }
}

TEST(WorkPrecision, SaysUpToWhereOmissionsAreComparedWithRunsThatWereStopped) {
  EXPECT_EQ(explain(Omissions{{.step = 2e-8}, 1.3e-13, 5.2, 0.00214}),
            "With nothing left out runs were stopped at the time limit. Until a strain of 0.214 % "
            "joint forces differ by 1.3e-13 at most, and a step takes 5.2 times the CPU time: "
            "active set, h = 20 ns, 8 triangles a fibre.");
}

TEST(WorkPrecision, NamesTheNearestWhereNothingReachesTheTarget) {
  HAVERS_SLOW;
  WorkPrecision study = compare_settings(test::tiny(Regime::quasi_static), {.seeds = 1});
  for (CheapestSetting& cheapest : study.cheapest) cheapest.row.reset();
  EXPECT_FALSE(cheapest_for_failure(study));
  for (BenchRow& row : study.rows) row.errors.failure_strain = {0.001, 0.001, 0.02, row.runs};
  study.rows[2].errors.failure_strain.high = 0.0042;               // the worst seed counts
  study.rows[3].errors.failure_strain = {0.001, 0.001, 0.001, 0};  // and so does one without
  EXPECT_TRUE(
      summary(study).starts_with("On the reference's mesh no other setting gives the failure "
                                 "strain to 0.1 % for every seed; the nearest comes to 0.42 %: " +
                                 to_string(study.rows[2].setting)))
      << summary(study);
  study.reference_errors.failure_strain.high = 0.0096;
  EXPECT_EQ(summary(study),
            "The reference's own failure strain may err by 0.96 %, which a step twice as long "
            "changes it by: which setting gives it to 0.1 % cannot be told.");
}

}  // namespace
}  // namespace havers::sim
