// Units in the names of columns, known and unknown, and brackets that hold none.
#include <gtest/gtest.h>

#include "io/machine/split_unit.hpp"
#include "tests/io/complaints.hpp"
#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

calib::RawTest test_of(const std::string& names, const ReadOptions& options = {}) {
  return test::read_content(names + "\n0;1\n1;2\n", options).test;
}

std::string refusal_of(const std::string& names, const ReadOptions& options = {}) {
  const Problem problem = test::first_problem_of([&] { test_of(names, options); });
  return problem.what + " (" + problem.hint + ")";
}

TEST(WrittenUnits, OfAForceAreReadInEveryForm) {
  for (const auto& [name, newton] : {std::pair{"Load (daN)", 10.0},
                                     {"Load/kN", 1e3},
                                     {"Load / kN", 1e3},
                                     {"Kraft in kN", 1e3},
                                     {"force_kN", 1e3},
                                     {"max_force_kN", 1e3},
                                     {"Load, kN", 1e3},
                                     {"Load kN", 1e3},
                                     {"Load (Newtons)", 1.0},
                                     {"Load (kp)", 9.80665}}) {
    SCOPED_TRACE(name);
    const calib::RawTest test = test_of(std::string("Time (s);") + name);
    EXPECT_DOUBLE_EQ(test.force.at(1), 2.0 * newton);
    EXPECT_TRUE(test.warnings.empty());
  }
}

TEST(WrittenUnits, OfStrainLengthStressAndTimeAreReadToo) {
  EXPECT_DOUBLE_EQ(test_of("strain_pct;Load (N)").strain.at(1), 0.01);
  EXPECT_DOUBLE_EQ(test_of("Strain (‰);Load (N)").strain.at(1), 0.001);
  EXPECT_DOUBLE_EQ(test_of("Dehnung in %;Load (N)").strain.at(1), 0.01);
  EXPECT_DOUBLE_EQ(test_of("Extension (microns);Load (N)").extension.at(1), 1e-6);
  EXPECT_DOUBLE_EQ(test_of("Time (minutes);Load (N)").time.at(1), 60.0);
  for (const char* name : {"Time (us)", "Time (µs)", "Zeit [μs]", "time_us", "Time / usec"})
    EXPECT_DOUBLE_EQ(test_of(name + std::string(";Load (N)")).time.at(1), 1e-6) << name;
  for (const char* name : {"Strain (ppm)", "Strain [1e-6]", "Strain (10^-6)"})
    EXPECT_DOUBLE_EQ(test_of(name + std::string(";Load (N)")).strain.at(1), 1e-6) << name;
  EXPECT_DOUBLE_EQ(test_of("Time (s);Stress/N/mm2").stress.at(1), 2e6);
  EXPECT_DOUBLE_EQ(test_of("Width_mm;4,02\nTime (s);Load (N)").width.value(), 4.02e-3);
}

TEST(WrittenUnits, ThatAreNotKnownAreNamed) {
  const std::string sentence =
      "unit \"daX\" of column \"Load\" is not known (say force_unit = ... in [specimen.columns])";
  EXPECT_EQ(refusal_of("Time (s);Load (daX)"), sentence);
  EXPECT_EQ(refusal_of("Time;Load\n(s);(daX)"), sentence);
  EXPECT_EQ(refusal_of("Time (s);Load (daX)", {{{Quantity::force, {"Load", ""}}}}), sentence);
  EXPECT_NE(refusal_of("Time (s);Load (kg)").find("\"kg\""), std::string::npos);
  const calib::RawTest test = test_of("Strain (kX);Load (N)");
  EXPECT_TRUE(test.strain.empty());
  EXPECT_EQ(test.warnings.at(0),
            "unit \"kX\" of column \"Strain\" is not known: not used (say strain_unit = ... in "
            "[specimen.columns])");
}

TEST(WrittenUnits, AreSaidByTheCommandLineOfATestInNoStudy) {
  EXPECT_EQ(refusal_of("Time (s);Load (daX)", {.alone = true}),
            "unit \"daX\" of column \"Load\" is not known (say --set columns.force_unit=...)");
  EXPECT_EQ(
      refusal_of("Time (s);Extension (mm)", {.alone = true}),
      "no column holds a force or a stress (the columns are Time (s), Extension (mm); name it "
      "by --set columns.KEY=VALUE)");
  EXPECT_EQ(refusal_of("Time (s);Load (V)", {.alone = true}),
            "column \"Load\" is in volts (say what a volt is, as in --set "
            "columns.force_unit='500 N/V')");
  EXPECT_EQ(test_of("Load (N);Load 2 (N)", {.alone = true}).warnings.at(0),
            "columns \"Load\" and \"Load 2\" both hold force: \"Load\" is used (--set "
            "columns.force=2 takes the other)");
}

// The logger's force may tell what a volt of the load is, but nothing tells that of the strain.
TEST(WrittenUnits, InVoltsAreThoseOfTheLoadWhereALoggerIs) {
  const auto test = test_of("Time (s);Load (V);Strain (V)", {.has_logger = true});
  EXPECT_FALSE(test.load_volts.empty());
  EXPECT_EQ(test.warnings.at(0),
            "column \"Strain\" is in volts: not used (say what a volt is in [specimen.columns], as "
            "in force_unit = \"500 N/V\")");
}

TEST(WrittenUnits, AreOverruledByTheUser) {
  for (const char* column : {"Load", "Load (daX)", "2"}) {
    const ReadOptions options{{{Quantity::force, {column, "kN"}}}};
    EXPECT_DOUBLE_EQ(test_of("Time (s);Load (daX)", options).force.at(1), 2000.0) << column;
  }
  const ReadOptions options{{{Quantity::force, {"force_kN", "N"}}}};
  EXPECT_DOUBLE_EQ(test_of("Time (s);force_kN", options).force.at(1), 2.0);
}

// As the sentences on unknown units say: force_unit alone, without force.
TEST(WrittenUnits, AreOverruledByAUnitAlone) {
  for (const char* names : {"Time (s);Load", "Time (s);Load (daX)", "Time (s);Load (N)"}) {
    const calib::RawTest test = test_of(names, {.units = {{Quantity::force, "kN"}}});
    EXPECT_DOUBLE_EQ(test.force.at(1), 2000.0) << names;
    EXPECT_TRUE(test.warnings.empty()) << names;
  }
  EXPECT_DOUBLE_EQ(
      test_of("Time (s);Load (V)", {.units = {{Quantity::force, "500 N/V"}}}).force.at(1), 1000.0);
  const ReadOptions percent{.units = {{Quantity::strain, "%"}}};
  EXPECT_DOUBLE_EQ(test_of("Strain;Load (N);Strain 2 (mm/mm)", percent).strain.at(1), 0.01);
  EXPECT_TRUE(refusal_of("Strain (mm/mm);Load (N);Strain 2 (mm/mm)", percent)
                  .starts_with("several columns speak of strain, and strain_unit does not say"));
  EXPECT_EQ(refusal_of("Time (s);Load (N)", {.units = {{Quantity::strain, "%"}}}),
            "no column's name speaks of strain, but strain_unit is given (say strain = ... in "
            "[specimen.columns]; the columns are Time (s), Load (N))");
  EXPECT_EQ(
      refusal_of("Time (s);Load (N)", {.units = {{Quantity::force, "mm"}}}),
      "\"mm\" is not a known unit of force (force_unit may be N, kN, lbf, kgf, V, or a factor "
      "such as 500 N/V)");
}

// Only a force and a strain have a factor to wait for.
TEST(WrittenUnits, InVoltsAreOfForceAndStrainAlone) {
  const char* const names = "Time (s);Load (N);Extension (mm)";
  const std::string refusal =
      "\"V\" is not a known unit of time (time_unit may be s, ms, us, min or h)";
  EXPECT_EQ(refusal_of(names, {.units = {{Quantity::time, "V"}}}), refusal);
  EXPECT_EQ(refusal_of(names, {{{Quantity::time, {"1", "V"}}}}), refusal);
  EXPECT_EQ(refusal_of(names, {.units = {{Quantity::extension, "V"}}}),
            "\"V\" is not a known unit of extension (extension_unit may be mm, um, m or in)");
}

TEST(WrittenUnits, OfAColumnThatTheUserNamesAreThoseOfItsQuantity) {
  const auto named = [](Quantity quantity, const char* column) {
    return ReadOptions{{{quantity, {column, ""}}}};
  };
  EXPECT_EQ(refusal_of("Load (N);Extension (mm)", named(Quantity::force, "Extension")),
            "column \"Extension\" is in mm, which is no unit of force (name another, or say "
            "force_unit = ... in [specimen.columns])");
  EXPECT_NE(refusal_of("Time (s);Load (V)", named(Quantity::force, "Load"))
                .find("column \"Load\" is in volts"),
            std::string::npos);
  EXPECT_EQ(refusal_of("Load (N);Extension (mm)", named(Quantity::strain, "Extension")),
            "column \"Extension\" is an elongation, and the gauge length is unknown (say "
            "gauge_length_mm)");
}

TEST(WrittenUnits, ThatAreNotKnownInALoggerAreAskedForInItsTable) {
  EXPECT_EQ(test_of("Time (s);Extension (mm);Strain (kX)", {.logger = true}).warnings.at(0),
            "unit \"kX\" of column \"Strain\" is not known: not used (say strain_unit = ... in "
            "[specimen.gauge_columns])");
}

TEST(WrittenUnits, AreNotSeenWhereThereIsNone) {
  for (const char* name :
       {"Tensile strain (Strain 1)", "Load (channel 2)", "Extension (Crosshead)", "Load (raw)",
        "Kraft (Ist)", "Strain (DIC)", "Load (LVDT)", "Force_min", "Load_in", "Strain_m",
        "Sampling rate 1/s", "S/No", "Speed/mm/min", "Gage length, standard travel", "C_1_N"}) {
    EXPECT_EQ(split_unit(name).name, name);
    EXPECT_EQ(split_unit(name).unit, "") << name;
  }
  EXPECT_EQ(test_of("Time (s);Load (channel 2)").warnings.at(0),
            "column \"Load (channel 2)\" has no unit, taken as N");
}

TEST(WrittenUnits, InBracketsWithinANameAreRead) {
  for (const auto& [name, newton] : {std::pair{"Force (lbf) A", 4.4482216152605},
                                     {"Force (kN) (filtered)", 1e3},
                                     {"Load [kN] 1", 1e3},
                                     {"[kN] Kraft", 1e3},
                                     {"Load (kN) (1)", 1e3}}) {
    SCOPED_TRACE(name);
    const calib::RawTest test = test_of(std::string("Time (s);") + name);
    EXPECT_DOUBLE_EQ(test.force.at(1), 2.0 * newton);
    EXPECT_TRUE(test.warnings.empty());
    const ReadOptions named{{{Quantity::force, {name, ""}}}};
    EXPECT_DOUBLE_EQ(test_of(std::string("Time (s);") + name, named).force.at(1), 2.0 * newton);
  }
  EXPECT_DOUBLE_EQ(test_of("Strain [%] (gauge);Load (N)").strain.at(1), 0.01);
  EXPECT_DOUBLE_EQ(test_of("Time (min) elapsed;Load (N)").time.at(1), 60.0);
  EXPECT_EQ(split_unit("Force (kN) (filtered)").name, "Force (filtered)");
  // A signal with the range of its load cell; what a strain cannot have.
  EXPECT_EQ(split_unit("Load (kN) [V]").unit, "V");
  EXPECT_EQ(split_unit("Strain (s) (gauge)").unit, "");
}

}  // namespace
}  // namespace havers::io
