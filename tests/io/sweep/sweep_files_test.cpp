// The files of a sweep, read back.
#include "io/sweep/sweep_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "io/machine/csv_rows.hpp"
#include "io/sweep/read_sweep.hpp"
#include "tests/io/complaints.hpp"
#include "tests/io/sweep/small_sweep.hpp"

namespace havers::io {
namespace {

using test::ScratchFolder;

TEST(SweepFiles, HaveARowForEveryRunAndForEveryPointAndMeasure) {
  const ScratchFolder folder;
  const calib::Sweep sweep = read_sweep(folder.write("s.toml", test::small_sweep)).sweep;
  const calib::SweepResult result = calib::run_sweep(sweep, nullptr, 1, {});
  const std::string runs = runs_csv(sweep, result);
  EXPECT_THAT(runs, testing::StartsWith("point,level,joints.distribution,joints.scatter,seed,"
                                        "outcome,strength_Pa,failure_strain,modulus_Pa"));
  EXPECT_EQ(std::ranges::count(runs, '\n'), 1 + 4 * 3);
  EXPECT_EQ(std::ranges::count(summary_csv(sweep, result), '\n'), 1 + 4 * 5);
}

TEST(SweepFiles, ExportTheLawsAndTheFindings) {
  const ScratchFolder folder;
  const calib::Sweep sweep = read_sweep(folder.write("s.toml", test::small_sweep)).sweep;
  const calib::SweepResult result = calib::run_sweep(sweep, nullptr, 1, {});
  const nlohmann::json laws = laws_json(result);
  EXPECT_EQ(laws["laws"][0]["terms"][0], "joints.scatter");
  EXPECT_EQ(laws["laws"][0]["coefficients"].size(), 2U);
  const std::vector<calib::SweepLaw> read = read_laws(folder.write("laws.json", laws.dump()));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].terms, result.laws[0].request.terms);
  EXPECT_EQ(read[0].coefficients, result.laws[0].coefficients);
  const nlohmann::json json = sweep_json(sweep, result);
  EXPECT_EQ(json["points"][2]["keys"]["joints.distribution"], "weibull");
  EXPECT_EQ(json["points"][2]["measures"]["strength_Pa"]["n"], 3);
  EXPECT_EQ(json["points"][2]["with_reservation"], 0);
  EXPECT_EQ(json["most_reserved_because"], "");
  EXPECT_EQ(json["findings"][0]["id"], "A");
  EXPECT_EQ(json["findings"][0]["what"],
            "joints.scatter = 0.8 against 0.2, joints.distribution = weibull");
}

TEST(SweepFiles, RefuseWhatIsNoFileOfLaws) {
  const ScratchFolder folder;
  for (const char* text : {"", "{}", "[1]", R"({"laws": 3})", R"({"laws": []})",
                           R"({"laws": [{"response": "failure_strain", "status": "fitted"}]})"})
    EXPECT_THROW(read_laws(folder.write("laws.json", text)), InputError) << text;
}

std::vector<std::string> third_column_of(const std::string& table, std::size_t columns) {
  std::vector<std::string> cells;
  CsvRows reader(',', [&](const Row& row) {
    EXPECT_EQ(row.cells.size(), columns) << table;
    cells.emplace_back(row.cells[2]);
    return true;
  });
  reader.feed(table);
  reader.finish();
  return cells;
}

TEST(SweepFiles, HoldTextsAsTheyAreMeantWithCommasToo) {
  const ScratchFolder folder;
  for (const char* file : {"a,b.csv", "c.csv"}) folder.write(file, "joint,f_N,f_T\n0,3,4\n");
  const calib::Sweep sweep = read_sweep(folder.write("s.toml", R"([sweep]
seeds = 1
[sweep.keys]
"joints.thresholds_file" = ["a,b.csv", "c.csv"]
[assembly]
layers = 1
fibres = 2
[solver]
regime = "quasi-static"
[[law]]
response = "strength"
per = "joints.thresholds_file"
)"))
                                 .sweep;
  const calib::SweepResult result = calib::run_sweep(sweep, nullptr, 1, {});
  EXPECT_THAT(third_column_of(runs_csv(sweep, result), 6 + result.known().size()),
              testing::ElementsAre("joints.thresholds_file", "a,b.csv", "c.csv"));
  EXPECT_THAT(third_column_of(summary_csv(sweep, result), 9), testing::Contains("a,b.csv"));
  EXPECT_EQ(sweep_json(sweep, result)["points"][0]["keys"]["joints.thresholds_file"], "a,b.csv");
  EXPECT_EQ(laws_json(result)["laws"][1]["at"], "c.csv");
}

}  // namespace
}  // namespace havers::io
