// Of several columns that may hold a channel, the one that measured it.
#include <gtest/gtest.h>

#include "io/input_error.hpp"
#include "tests/io/complaints.hpp"
#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

using test::read_content;

// The better column stands last; the number is in its row.
TEST(ColumnChoice, TakesTheBetterColumnWhereverItStands) {
  const std::vector<std::string> strains{"Strain 1 (Displacement) (%),Strain 2 (%)",
                                         "Crosshead strain (%),Strain (%)",
                                         "Nominal strain (%),Strain (%)",
                                         "True strain (%),Engineering strain (%)",
                                         "Transverse strain (%),Axial strain (%)",
                                         "Strain (%),Extensometer strain (%)",
                                         "Querdehnung (%),Dehnung (%)",
                                         "Traversendehnung (%),Dehnung (%)",
                                         "Strain command (%),Strain (%)",
                                         "Tensile strain (Extension) (%),Strain 1 (%)",
                                         "Dehnung (%),Feindehnung (%)"};
  for (const std::string& names : strains) {
    const TestFile file = read_content("Load (N)," + names + "\n1,7,2\n2,8,3\n3,9,4\n");
    EXPECT_EQ(file.test.strain, (std::vector{0.02, 0.03, 0.04})) << names;
  }
  for (const std::string names :
       {"Peak load (N),Load (N)", "Command force (N),Force (N)", "Kraft Sollwert (N),Kraft (N)",
        "Force consigne (N),Force (N)", "Force setpoint (N),Force (N)", "Maximum load (N),Load (N)",
        "Force (N),Load cell (N)"}) {
    const TestFile file = read_content(names + "\n7,2\n8,3\n");
    EXPECT_EQ(file.test.force, (std::vector{2.0, 3.0})) << names;
  }
}

TEST(ColumnChoice, TakesAnExtensometersDisplacementForAGauge) {
  const TestFile file = read_content(
      "Gauge length,50,mm\nLoad (N),Strain 2 (Displacement) (%),Displacement (Strain 1) (mm)\n"
      "1,7,0.05\n2,8,0.1\n");
  EXPECT_EQ(file.test.strain, (std::vector{1e-3, 2e-3}));
}

TEST(ColumnChoice, SaysWhatIsUsedForWantOfBetter) {
  const TestFile file = read_content("Load (N),Strain 1 (Displacement) (%)\n1,2\n2,3\n");
  EXPECT_EQ(file.test.strain, (std::vector{0.02, 0.03}));
  EXPECT_EQ(file.test.warnings.at(0),
            "column \"Strain 1 (Displacement)\" is used for want of a better one: it is the "
            "crosshead's by its name, with the compliance of the machine in it");
  EXPECT_TRUE(file.test.crosshead_strain);
  EXPECT_FALSE(read_content("Load (N),Strain (%)\n1,2\n2,3\n").test.crosshead_strain);
  EXPECT_EQ(
      read_content("Load (N),True strain (%),True stress (MPa)\n1,2,1\n2,3,2\n").test.warnings,
      std::vector<std::string>{"column \"True strain\" is used for want of a better one: it "
                               "is true and not engineering"});
}

// What travels is no strain but in the unit of one, and then the crosshead's unless the user says.
TEST(ColumnChoice, TakesAnElongationInPercentForAStrainOfTheCrosshead) {
  for (const char* name : {"Elongation (%)", "Extension (%)", "Allongement (%)"}) {
    const std::string content = "Load (N)," + std::string(name) + "\n1,2\n2,3\n";
    const TestFile file = read_content(content);
    EXPECT_EQ(file.test.strain, (std::vector{0.02, 0.03})) << name;
    EXPECT_TRUE(file.test.crosshead_strain) << name;
    ReadOptions options;
    options.columns[Quantity::strain].column = "2";
    const TestFile said = read_content(content, options);
    EXPECT_EQ(said.test.strain, (std::vector{0.02, 0.03})) << name;
    EXPECT_FALSE(said.test.crosshead_strain) << name;
  }
  EXPECT_EQ(read_content("Load (N),Elongation (%),Strain (%)\n1,7,2\n2,8,3\n").test.strain,
            (std::vector{0.02, 0.03}));
}

TEST(ColumnChoice, AsksForTheGaugeLengthOfALoggersElongation) {
  const auto problem = test::first_problem_of(
      [] { read_content("Time (s),Extensometer (mm)\n0,1\n1,2\n", {.logger = true}); });
  EXPECT_EQ(problem.what,
            "column \"Extensometer\" is an elongation, and the gauge length is unknown");
}

// The better known is the unit; what follows from it has to be seen.
TEST(ColumnChoice, SaysWhereNameAndUnitContradictEachOther) {
  const auto warnings_of = [](const std::string& names) {
    return read_content(names + "\n1,2,3\n2,3,4\n").test.warnings;
  };
  const std::vector<std::string> both = warnings_of("Load (N),Extension (N),Strain (%)");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(both[0].starts_with("columns \"Load\" and \"Extension\" both hold force"));
  EXPECT_EQ(both[1],
            "column \"Extension\" is extension by its name and force by its unit, N: the unit is "
            "believed (extension_unit = ... in [specimen.columns] corrects it)");
  EXPECT_EQ(
      warnings_of("Load (N),Stress (mm),Strain (%)"),
      std::vector<std::string>{
          "column \"Stress\" is stress by its name and extension by its unit, mm: the unit is "
          "believed (stress_unit = ... in [specimen.columns] corrects it)"});
  // Neither is taken, and of both there are better ones.
  EXPECT_EQ(warnings_of("Load (N),Extension (mm),Load (mm)").size(), 1U);
  EXPECT_TRUE(warnings_of("Load (N),Extension (mm),Strain (mm/mm)").empty());
}

// Tension in such a record is negative, and compression in it is no tension.
TEST(ColumnChoice, TurnsWhatCountsCompression) {
  const std::string numbers = "-1,-0.2,-3\n-2,-0.4,-3\n";
  for (const std::string names :
       {"Compressive load (N),Compressive strain (%),x", "Druckkraft (N),Compression strain (%),x",
        "Carga de compresión (N),Deformación de compresión (%),x"}) {
    const TestFile file = read_content(names + "\n" + numbers);
    EXPECT_EQ(file.test.force, (std::vector{1.0, 2.0})) << names;
    EXPECT_EQ(file.test.strain, (std::vector{0.002, 0.004})) << names;
  }
  const std::string both = "Load cell tension/compression (N)";
  EXPECT_EQ(read_content(both + ",Strain (%)\n1,2\n2,3\n").test.force, (std::vector{1.0, 2.0}));
  const auto warnings =
      read_content("Compressive stress (MPa),Strain (%)\n1,2\n2,3\n").test.warnings;
  EXPECT_EQ(warnings,
            std::vector<std::string>{"column \"Compressive stress\" counts compression, by "
                                     "its name: its sign is turned"});
}

// Nothing is read of it, and rows of it are rows of numbers.
TEST(ColumnChoice, PassesOverAColumnOfClockTimes) {
  for (const std::string first :
       {"10:00:01", "2026-05-01T10:00:01", "01/05/2026 10:00:01", "1/5/2026 10:00:01 AM"}) {
    const TestFile file =
        read_content("Clock,Load (N),Strain (%)\n" + first + ",1,0.1\n" + first + ",2,0.2\n");
    EXPECT_EQ(file.test.force, (std::vector{1.0, 2.0})) << first;
    EXPECT_EQ(file.test.strain, (std::vector{0.001, 0.002})) << first;
  }
}

TEST(ColumnChoice, PassesOverAColumnOfText) {
  for (const std::string text : {"2024-03-12T10:00:00.000+01:00", "Ramp 1", "OK", "-", ":"}) {
    const auto row = [&](const char* numbers) { return text + numbers; };
    const TestFile commas = read_content("Width,4,mm\n\nStage,Time (s),Load (N)\n" +
                                         row(",0.000,1\n") + row(",0.125,2\n"));
    EXPECT_EQ(commas.test.time, (std::vector{0.0, 0.125})) << text;
    EXPECT_EQ(commas.test.force, (std::vector{1.0, 2.0})) << text;
    EXPECT_EQ(commas.test.width, 4e-3) << text;
    const TestFile german =
        read_content("Stufe;Zeit (s);Kraft (N)\n" + row(";0,000;1,5\n") + row(";0,125;2,5\n") +
                     "Stufe;Zeit (s);Kraft (N)\n" + row(";0,250;3,5\n") + row(";0,375;4,5\n"));
    EXPECT_EQ(german.test.time, (std::vector{0.0, 0.125, 0.25, 0.375})) << text;
    EXPECT_EQ(german.test.force, (std::vector{1.5, 2.5, 3.5, 4.5})) << text;
    EXPECT_THROW(read_content("Time,Load (N),Strain (%)\n" + row(",1,0.1\n") + row(",2,0.2\n")),
                 InputError)
        << text;
  }
  EXPECT_THROW(read_content("Specimen,Load (N),Extension (mm)\nA1,700,1.1\nA2,800,1.2\n"),
               InputError);
}

// Where it is the time, it counts from its own zero.
TEST(ColumnChoice, ReadsTheTimeOfAClock) {
  for (const char* name : {"Time", "Zeit (hh:mm:ss)", "Time (s)", "Time (min)", "Time (ms)"}) {
    const TestFile file = read_content(std::string(name) +
                                       ";Force (N);Strain (%)\n"
                                       "09:59:59,5;1;0,1\n10:00:00,0;2;0,2\n");
    EXPECT_EQ(file.test.time, (std::vector{35999.5, 36000.0})) << name;
  }
  const TestFile logger = read_content(
      "Time,Strain (%)\n2026-05-01 09:59:59,0.1\n2026-05-01 10:00:00,0.2\n", {.logger = true});
  EXPECT_EQ(logger.test.time, (std::vector{35999.0, 36000.0}));
}

TEST(ColumnChoice, ReadsAClockOfTwelveHoursThroughNoon) {
  const TestFile logger = read_content(
      "Time,Strain (%)\n11:59:59 AM,0.1\n12:00:00 PM,0.2\n1:00:00 PM,0.3\n", {.logger = true});
  EXPECT_EQ(logger.test.time, (std::vector{43199.0, 43200.0, 46800.0}));
}

TEST(ColumnChoice, FollowsAClockThroughMidnight) {
  const char* const rows = "2026-05-01 23:59:59,1\n2026-05-02 00:00:00,2\n2026-05-02 00:00:01,3\n";
  const TestFile file = read_content(std::string("Time,Load (N)\n") + rows);
  EXPECT_EQ(file.test.time, (std::vector{86399.0, 86400.0, 86401.0}));
  EXPECT_THROW(read_content("Time,Load (N)\n10:00:05,1\n10:00:00,2\n"), InputError);
}

TEST(ColumnChoice, PassesOverADateWithDots) {
  const TestFile file = read_content(
      "Datum;Uhrzeit;Kraft (N)\n01.05.2026;10:00:00;1,5\n"
      "01.05.2026;10:00:01;2,5\n");
  EXPECT_EQ(file.test.time, (std::vector{36000.0, 36001.0}));
  EXPECT_EQ(file.test.force, (std::vector{1.5, 2.5}));
}

TEST(ColumnChoice, TakesNoSizeForAReadingAndSaysWhatAUnitAloneDecides) {
  EXPECT_TRUE(read_content("Time (s),Load (N),Width (mm)\n0,1,4\n1,2,4\n").test.extension.empty());
  const TestFile file = read_content("Time (s),Load (N),LE1 (mm)\n0,1,0\n1,2,0.1\n");
  EXPECT_EQ(file.test.extension, (std::vector{0.0, 1e-4}));
  EXPECT_EQ(file.test.warnings.at(0),
            "column \"LE1\" is taken as extension by its unit alone (extension = ... in "
            "[specimen.columns] takes another)");
}

TEST(ColumnChoice, ReadsMicrostrainAsItIsWritten) {
  for (const char* unit : {"µstrain", "μstrain", "ustrain", "uε"}) {
    const TestFile file =
        read_content(std::string("Load (N),Strain (") + unit + ")\n1,100\n2,200\n");
    EXPECT_DOUBLE_EQ(file.test.strain.at(1), 2e-4) << unit;
    EXPECT_TRUE(file.test.warnings.empty()) << unit;
  }
}

TEST(ColumnChoice, RefusesASpecimenThatGoesOnAfterItsEnd) {
  EXPECT_THROW(read_content("Specimen 1,,Specimen 2,\nLoad (N),Strain (%),Load (N),Strain (%)\n"
                            "1,1,1,1\n,,2,2\n3,3,3,3\n"),
               InputError);
}

TEST(ColumnChoice, NamesTheKeyOfASignalInVolts) {
  const TestFile file = read_content(
      "Time (s),Strain gauge 1 (V),Strain gauge 2 (V)\n0,1,2\n1,2,3\n", {.logger = true});
  EXPECT_EQ(
      file.test.warnings.at(0),
      "columns \"Strain gauge 1\" and \"Strain gauge 2\" both hold volts: \"Strain gauge 1\" is "
      "used (strain = 3 in [specimen.gauge_columns] takes the other)");
}

// Neither what was asked of the machine nor what is across the load is a test.
TEST(ColumnChoice, TakesNoColumnThatIsNoReading) {
  const TestFile file = read_content("Load (N),Transverse strain (%)\n1,2\n2,3\n");
  EXPECT_TRUE(file.test.strain.empty());
  EXPECT_EQ(file.columns[1].quantity, Quantity::other);
  EXPECT_THROW(read_content("Time (s),Peak load (N),Command force (kN)\n0,1,1\n1,2,2\n"),
               InputError);
}

}  // namespace
}  // namespace havers::io
