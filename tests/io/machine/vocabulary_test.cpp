#include "io/machine/vocabulary.hpp"

#include <gtest/gtest.h>

#include "io/machine/fact_names.hpp"
#include "io/machine/split_unit.hpp"
#include "io/machine/units.hpp"
#include "io/machine/words.hpp"

namespace havers::io {
namespace {

TEST(Words, AreLowerInAllLettersOfEurope) {
  EXPECT_EQ(lower("SIŁA ŻÓŁTA ĆĘŃŚŹ Ÿ ÉÄÞ"), "siła żółta ćęńśź ÿ éäþ");
  EXPECT_EQ(lower("ČĎĽŇŘŠŤŮŽŐŰ"), "čďľňřšťůžőű");
  for (const char* const same : {"2×3", "試験力", "żółw ÿ ß ĸ ſ", "\xC5"})
    EXPECT_EQ(lower(same), same);
}

TEST(Units, AreThoseOfTheirDefinition) {
  EXPECT_DOUBLE_EQ(find_unit("kN")->to_si, 1000.0);
  EXPECT_NEAR(find_unit("lbf")->to_si, 4.4482216152605, 1e-12);
  EXPECT_NEAR(find_unit("kgf/mm2")->to_si, 9.80665e6, 1e-6);
  EXPECT_NEAR(find_unit("psi")->to_si, 6894.757293168, 1e-8);
  EXPECT_NEAR(find_unit("ksi")->to_si, 6894757.293168, 1e-5);
  EXPECT_DOUBLE_EQ(find_unit("µm")->to_si, 1e-6);
  EXPECT_DOUBLE_EQ(find_unit("με")->to_si, 1e-6);
  EXPECT_EQ(find_unit("mm²")->dimension, Dimension::area);
  EXPECT_FALSE(find_unit("mm/min"));
  EXPECT_FALSE(find_unit(""));
}

TEST(Units, MeanTheirCaseFirst) {
  EXPECT_DOUBLE_EQ(find_unit("mN")->to_si, 1e-3);
  EXPECT_DOUBLE_EQ(find_unit("MN")->to_si, 1e6);
  EXPECT_DOUBLE_EQ(find_unit("KN")->to_si, 1e3);
  EXPECT_DOUBLE_EQ(find_unit("[ mpa ]")->to_si, 1e6);
}

TEST(Units, AreSplitFromTheName) {
  EXPECT_EQ(split_unit("Force [ kN ]").name, "Force");
  EXPECT_EQ(split_unit("Force [ kN ]").unit, "kN");
  EXPECT_EQ(split_unit("C_1_Cycles[]").name, "C_1_Cycles");
  EXPECT_EQ(split_unit("Tensile strain (Strain 1)").name, "Tensile strain (Strain 1)");
  EXPECT_EQ(split_unit("(mm)").name, "(mm)");
}

TEST(Vocabulary, KnowsTheColumnsOfEightLanguages) {
  using enum Quantity;
  const std::vector<std::pair<const char*, Quantity>> names{
      {"Time", time},
      {"Temps", time},
      {"Prüfzeit", time},
      {"Tiempo", time},
      {"Tempo", time},
      {"Czas", time},
      {"时间", time},
      {"Load", force},
      {"Standardkraft", force},
      {"Carga", force},
      {"Forza", force},
      {"Siła", force},
      {"OBCIĄŻENIE", force},
      {"WYDŁUŻENIE", extension},
      {"Força", force},
      {"力", force},
      {"Extension", extension},
      {"DÉPLACEMENT", extension},
      {"Traversenweg", extension},
      {"Desplazamiento", extension},
      {"Spostamento", extension},
      {"Przemieszczenie", extension},
      {"Deslocamento", extension},
      {"位移", extension},
      {"Tensile strain (Strain 1)", strain},
      {"Déformation", strain},
      {"Dehnung", strain},
      {"Deformación", strain},
      {"Deformazione", strain},
      {"Odkształcenie", strain},
      {"Deformação", strain},
      {"应变", strain},
      {"Tensile stress", stress},
      {"Contrainte", stress},
      {"Zugspannung", stress},
      {"Esfuerzo", stress},
      {"Tensione", stress},
      {"Naprężenie", stress},
      {"Tensão", stress},
      {"应力", stress},
  };
  for (const auto& [name, quantity] : names) EXPECT_EQ(quantity_of_name(name), quantity) << name;
}

TEST(Vocabulary, DoesNotTakeAWordInsideAnotherForItself) {
  EXPECT_EQ(quantity_of_name("Elastic"), Quantity::other);      // "last"
  EXPECT_EQ(quantity_of_name("Temperature"), Quantity::other);  // "temps", "tempo"
  EXPECT_EQ(quantity_of_name("Strain rate"), Quantity::other);
  EXPECT_EQ(quantity_of_name("Traverse speed"), Quantity::other);
  EXPECT_EQ(quantity_of_name("Cycle count"), Quantity::other);
}

TEST(Vocabulary, KnowsTheFactsOfASpecimen) {
  EXPECT_EQ(fact_of_key("Specimen ID"), Fact::specimen_id);
  EXPECT_EQ(fact_of_key("Geometry : Width"), Fact::width);
  EXPECT_EQ(fact_of_key("Épaisseur éprouvette"), Fact::thickness);
  EXPECT_EQ(fact_of_key("Gage length, standard travel"), Fact::gauge_length);
  EXPECT_EQ(fact_of_key("Cross-section:"), Fact::area);
  EXPECT_FALSE(fact_of_key("Final width"));
  for (const char* key : {"Specimen", "Specimen no.", "Specimen number", "Specimen: ", "Probe Nr.",
                          "Sample", "Sample #", "Éprouvette n°", "Test no."})
    EXPECT_EQ(fact_of_key(key), Fact::specimen_number) << key;
  for (const char* key : {"Test", "Sample rate", "Specimen material", "Probenform", "Samples"})
    EXPECT_FALSE(fact_of_key(key)) << key;
}

TEST(Vocabulary, KnowsASpecimensNameInAHeading) {
  EXPECT_EQ(name_in_heading("Specimen 4"), "4");
  EXPECT_EQ(name_in_heading("Probe Nr. K-17"), "K-17");
  EXPECT_EQ(name_in_heading("Éprouvette n° 1"), "1");
  EXPECT_EQ(name_in_heading("Test 4"), "4");
  EXPECT_EQ(name_in_heading("Sample B"), "B");
  for (const char* heading : {"Test report", "Test report 12", "Specimen data", "Specimens 4",
                              "Specimen", "Test 12.03.2024 10:00"})
    EXPECT_TRUE(name_in_heading(heading).empty()) << heading;
}

}  // namespace
}  // namespace havers::io
