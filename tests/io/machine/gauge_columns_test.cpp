// Columns that a unit or a word gives away as a strain gauge's.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

TestFile table_of(const std::string& names, const ReadOptions& options = {}) {
  return test::read_content(names + "\n0,1,0.01,100\n1,2,0.02,200\n", options);
}

const std::string left_of_it = "Time (s),Load (N),Extension (mm),";

TEST(GaugeColumns, AreToldByAUnitOfStrainAlone) {
  for (const std::string name :
       {"CH1 (µε)", "Channel 3 [uStrain]", "A (ue)", "Def (µm/m)", "Ext. 1 (µε)", "ε (µε)",
        "MX1 (microstrain)", "Gage1 [uStrain]", "AI 0 in µm/m", "Microstrain"}) {
    const TestFile file = table_of(left_of_it + name);
    ASSERT_EQ(file.test.strain.size(), 2U) << name;
    EXPECT_DOUBLE_EQ(file.test.strain[1], 2e-4) << name;
    EXPECT_FALSE(file.test.crosshead_strain) << name;
  }
  EXPECT_EQ(
      table_of(left_of_it + "CH1 (µε)").test.warnings,
      std::vector<std::string>{"column \"CH1\" is taken as strain by its unit alone (strain = "
                               "... in [specimen.columns] takes another)"});
  EXPECT_TRUE(table_of(left_of_it + "Elongation (µε)").test.crosshead_strain);
  EXPECT_TRUE(table_of(left_of_it + "Load cell (µε)").test.strain.empty());
}

TEST(GaugeColumns, AreToldByTheWordsForThem) {
  for (const std::string name :
       {"DMS (µm/m)", "DMS1 in µm/m", "Dehnungsmessstreifen 1 (µm/m)", "Jauge 1 (µm/m)",
        "Jauge de contrainte (µm/m)", "SG1 (ue)", "Epsilon [µm/m]", "Tensometr (µm/m)",
        "Galga extensométrica (µm/m)"}) {
    const TestFile file = table_of(left_of_it + name);
    ASSERT_EQ(file.test.strain.size(), 2U) << name;
    EXPECT_DOUBLE_EQ(file.test.strain[1], 2e-4) << name;
    EXPECT_TRUE(file.test.warnings.empty()) << name;
  }
  for (const std::string name : {"Gauge 1 (%)", "DMS (%)", "ε (%)"})
    EXPECT_EQ(table_of(left_of_it + name).test.strain, (std::vector{1.0, 2.0})) << name;
}

TEST(GaugeColumns, AreTakenBeforeAStrainOfTheCrosshead) {
  const TestFile file = table_of("Time (s),Load (N),Strain 1 (Displacement) (%),CH1 (µε)");
  EXPECT_DOUBLE_EQ(file.test.strain.at(1), 2e-4);
  EXPECT_FALSE(file.test.crosshead_strain);
}

TEST(GaugeColumns, AcrossTheLoadAreNotTaken) {
  for (const std::string name : {"DMS quer (µm/m)", "SG trans (µε)", "Transverse (µε)"})
    EXPECT_TRUE(table_of(left_of_it + name).test.strain.empty()) << name;
  EXPECT_EQ(table_of("Time (s),Load (N),Exx (µε),Eyy (µε)").test.warnings.front(),
            "columns \"Exx\" and \"Eyy\" both hold strain: \"Exx\" is used (strain = 4 in "
            "[specimen.columns] takes the other)");
}

TEST(GaugeColumns, OfALoggerAreToldLikewise) {
  for (const std::string name : {"DMS 1 (µm/m)", "CH1 (µε)"})
    EXPECT_DOUBLE_EQ(table_of("Time (s),a,b," + name, {.logger = true}).test.strain.at(1), 2e-4);
}

// A logger records no crosshead: its extension is the gauge's, over the gauge's own length.
TEST(GaugeColumns, OfALoggerAreAnElongationOverTheirOwnLength) {
  const std::string numbers = "Time (s),Extension (mm)\n0,0.01\n1,0.02\n";
  const std::string own = "Gauge length,25,mm\nExtensometer gauge length,10,mm\n";
  const auto logged = [&](const std::string& head, std::optional<double> given) {
    return test::read_content(head + numbers, {.logger = true, .gauge_length = given}).test;
  };
  EXPECT_EQ(logged(own, {}).strain, (std::vector{1e-3, 2e-3}));
  EXPECT_TRUE(logged(own, {}).warnings.empty());
  EXPECT_FALSE(logged(own, {}).crosshead_strain);
  const calib::RawTest given = logged(own, 20e-3), bare = logged("Gauge length,10,mm\n", {});
  EXPECT_EQ(given.strain, (std::vector{5e-4, 1e-3}));
  EXPECT_NE(given.warnings.at(0).find("its extensometer has 10 mm"), std::string::npos);
  EXPECT_EQ(bare.strain, (std::vector{1e-3, 2e-3}));
  EXPECT_NE(bare.warnings.at(0).find("of an extensometer of another length"), std::string::npos);
  EXPECT_EQ(logged("", {}).extension, (std::vector{1e-5, 2e-5}));
  EXPECT_EQ(test::read_content(own + "Time (s),Load (N),Extension (mm)\n0,1,0.01\n1,2,0.02\n")
                .test.extension,
            (std::vector{1e-5, 2e-5}));
}

TEST(GaugeColumns, ThatMayBeOneAreSaidNotToBeRead) {
  const std::string said =
      "column \"D\" in % is not read: its name says no strain (strain = 4 in [specimen.columns] "
      "takes it for one)";
  EXPECT_EQ(table_of(left_of_it + "D (%)").test.warnings, std::vector<std::string>{said});
  EXPECT_TRUE(table_of(left_of_it + "T (°C)").test.warnings.empty());
  EXPECT_TRUE(table_of("Time (s),Load (N),D (%),Strain (%)").test.warnings.empty());
}

}  // namespace
}  // namespace havers::io
