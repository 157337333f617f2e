// The law E = E₀ (1−p)^m fitted over specimens that were never broken: against a regression in
// closed form, and against published samples where their folders are at hand: the environment
// variable HAVERS_REAL names the folder that holds them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "calib/fit/calibration.hpp"
#include "tests/support/studies.hpp"

namespace havers {
namespace {

struct Samples {
  std::vector<double> porosity, modulus;  // [-], [Pa]
};

// log E = a + b log(1−p) by least squares.
struct Regression {
  double value = 0.0, exponent = 0.0, exponent_error = 0.0;
};

Regression logarithmic_regression(const Samples& samples) {
  const auto n = static_cast<double>(samples.modulus.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < samples.modulus.size(); ++i) {
    mean_x += std::log1p(-samples.porosity[i]) / n;
    mean_y += std::log(samples.modulus[i]) / n;
  }
  for (std::size_t i = 0; i < samples.modulus.size(); ++i) {
    const double x = std::log1p(-samples.porosity[i]) - mean_x;
    xx += x * x;
    xy += x * (std::log(samples.modulus[i]) - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t i = 0; i < samples.modulus.size(); ++i)
    squares += std::pow(
        std::log(samples.modulus[i]) - mean_y - slope * (std::log1p(-samples.porosity[i]) - mean_x),
        2);
  return {std::exp(mean_y - slope * mean_x), slope, std::sqrt(squares / (n - 2.0) / xx)};
}

// What is known of a sample is its modulus: its test was stopped far below its strength.
calib::CalibrationResult fit(const Samples& samples) {
  calib::Study study;
  study.model.assembly.layers = 4;
  study.model.assembly.fibres = 3;
  study.model.loading.strain_rate = 1e-3;
  study.porosity = {.to_scatter = calib::ToScatter::none, .to_modulus = calib::ToModulus::power};
  study.calibrate.parameters = {"young_GPa", "modulus_exponent"};
  study.calibrate.terms = {"modulus"};
  study.calibrate.replicates = 2;
  for (std::size_t i = 0; i < samples.modulus.size(); ++i) {
    calib::Specimen specimen;
    specimen.id = fmt::format("S{}", i + 1);
    specimen.broke = false;
    specimen.porosity = samples.porosity[i];
    specimen.test = test::straight_test(samples.modulus[i], 1e6);
    study.specimens.push_back(std::move(specimen));
  }
  return calib::calibrate(study);
}

void expect_inside(const calib::CalibratedParameter& parameter, double value) {
  EXPECT_TRUE(parameter.identifiable) << parameter.left_out_because;
  EXPECT_LE(parameter.interval_95[0], value) << parameter.name;
  EXPECT_GE(parameter.interval_95[1], value) << parameter.name;
}

void expect_regression(const calib::CalibrationResult& result, const Regression& regression) {
  const auto young = test::parameter_of(result, "young_GPa");
  const auto exponent = test::parameter_of(result, "modulus_exponent");
  EXPECT_NEAR(young.value, 1e-9 * regression.value, 2e-3 * young.value);
  EXPECT_NEAR(exponent.value, regression.exponent, 0.02 * exponent.value);
  EXPECT_NEAR(exponent.standard_error / exponent.value,
              regression.exponent_error / regression.exponent,
              0.05 * regression.exponent_error / regression.exponent);
}

TEST(PorosityLaw, IsTheRegressionOfTheLogarithms) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Samples samples;
  for (int i = 0; i < 40; ++i) {
    samples.porosity.push_back(0.02 + 0.007 * i);
    samples.modulus.push_back(20e9 * std::pow(1.0 - samples.porosity.back(), 2.5) *
                              std::exp(0.08 * normal(random)));
  }
  const auto result = fit(samples);
  expect_regression(result, logarithmic_regression(samples));
  expect_inside(test::parameter_of(result, "young_GPa"), 20.0);
  expect_inside(test::parameter_of(result, "modulus_exponent"), 2.5);
  EXPECT_NEAR(result.specimen_effect[calib::modulus], 0.08, 0.02);
}

// The rows of a CSV file by their headings; a cell that is no number is NaN.
std::vector<std::map<std::string, double>> read_table(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  std::string line, cell;
  std::vector<std::string> headings;
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(file, line)) {
    if (line.ends_with('\r')) line.pop_back();
    std::istringstream cells(line);
    if (headings.empty()) {
      while (std::getline(cells, cell, ',')) headings.push_back(cell);
      continue;
    }
    auto& row = rows.emplace_back();
    for (const std::string& heading : headings) {
      cell.clear();
      std::getline(cells, cell, ',');
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      row[heading] = end == cell.c_str() ? std::nan("") : value;
    }
  }
  return rows;
}

class PublishedSamples : public testing::Test {
 protected:
  void SetUp() override {
    const char* named = std::getenv("HAVERS_REAL");
    if (named == nullptr) GTEST_SKIP() << "HAVERS_REAL does not name the folder of the samples";
    folder = named;
  }
  std::string folder;
};

// Young's moduli along and across the axis, of the stiffness of a transversely isotropic sample.
double along(const std::map<std::string, double>& c) {
  return c.at("S33") - std::pow(c.at("S13"), 2) / (c.at("S11") - c.at("S66"));
}
double across(const std::map<std::string, double>& c) {
  const double sum = 2.0 * (c.at("S11") - c.at("S66")), difference = 2.0 * c.at("S66");
  return difference * (c.at("S33") * sum - 2.0 * std::pow(c.at("S13"), 2)) /
         (c.at("S11") * c.at("S33") - std::pow(c.at("S13"), 2));
}

// 57 samples of human femora by ultrasound, FABCORT: 24.04 (1−p)^2.73 and 15.50 (1−p)^3.10 GPa.
TEST_F(PublishedSamples, OfFemoraByUltrasoundFollowTheirLaw) {
  const auto rows = read_table(folder + "/bone-elasticity-fabcort/Data_Cortical/00_RUSData.csv");
  Samples e3, e1;
  for (const auto& row : rows) {
    e3.porosity.push_back(1.0 - row.at("Rho"));
    e3.modulus.push_back(1e6 * along(row));
    e1.modulus.push_back(1e6 * across(row));
  }
  e1.porosity = e3.porosity;
  ASSERT_EQ(rows.size(), 57U);
  for (const auto& [samples, young, exponent] :
       {std::tuple(e3, 24.04, 2.73), std::tuple(e1, 15.50, 3.10)}) {
    const auto result = fit(samples);
    expect_regression(result, logarithmic_regression(samples));
    expect_inside(test::parameter_of(result, "young_GPa"), young);
    expect_inside(test::parameter_of(result, "modulus_exponent"), exponent);
    EXPECT_NEAR(test::parameter_of(result, "young_GPa").value, young, 0.005 * young);
    EXPECT_NEAR(test::parameter_of(result, "modulus_exponent").value, exponent, 0.02);
  }
}

// 74 samples of human femora in tension, FEMHIS: 15.60 ± 1.86 GPa, as a line 16.97 − 19.94 p.
TEST_F(PublishedSamples, OfFemoraInTensionFollowTheirLine) {
  Samples samples;
  for (const auto& row : read_table(folder + "/bone-tension-femhis/01_Data/FEMCOL.csv")) {
    const double modulus = row.at("Apparent Modulus Mineralized / GPa");
    const double solid = row.at("Bone Volume Fraction / -");
    if (!std::isfinite(modulus) || !std::isfinite(solid)) continue;
    samples.porosity.push_back(1.0 - solid);
    samples.modulus.push_back(1e9 * modulus);
  }
  ASSERT_EQ(samples.modulus.size(), 74U);
  const auto result = fit(samples);
  expect_regression(result, logarithmic_regression(samples));
  expect_inside(test::parameter_of(result, "young_GPa"), 16.97);
  // (1−p)^m falls by m at p = 0, the line by 19.94/16.97 of its beginning.
  expect_inside(test::parameter_of(result, "modulus_exponent"), 19.94 / 16.97);
  EXPECT_NEAR(result.specimen_effect[calib::modulus], 0.10, 0.01);
}

}  // namespace
}  // namespace havers
