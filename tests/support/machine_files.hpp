// Tensile tests whose answer is known, and the files that machines make of them.
#pragma once

#include <gtest/gtest.h>
#include <iconv.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include "calib/experiment/raw_test.hpp"
#include "tests/support/scratch_folder.hpp"

namespace havers::test {

/// A specimen that is linear to a sudden break, in a machine with slack, preload and noise. SI
/// units.
struct TensileTruth {
  double young = 13e9;
  double strength = 60e6;
  double width = 4e-3, thickness = 2e-3, gauge_length = 25e-3;
  double toe = 0.0;      ///< Strain that the slack costs. [-]
  double preload = 0.0;  ///< Force at the first row, where the strain is zeroed. [N]
  double force_noise = 0.0, strain_noise = 0.0;
  double strain_rate = 1e-4;
  double sampling = 0.1;  ///< [s]
  int rows_after_break = 5;
  int cycles = 0;           ///< Sinusoidal, of preload, before the loading.
  double cycle_part = 0.3;  ///< Their height, part of the failure strain. [-]
  int rows_per_cycle = 100;
  unsigned seed = 1;

  [[nodiscard]] double area() const { return width * thickness; }
  [[nodiscard]] double failure_strain() const { return strength / young; }
};

/// Stress at strain e: σ = E (e − a + a exp(−e/a)), which starts flat and tends to a line shifted
/// by the toe a.
inline double stress_with_toe(const TensileTruth& truth, double e) {
  if (truth.toe <= 0.0) return truth.young * e;
  return truth.young * (e - truth.toe + truth.toe * std::exp(-e / truth.toe));
}

/// The strain where that stress is reached, by bisection.
inline double strain_with_toe(const TensileTruth& truth, double stress) {
  double low = 0.0, high = stress / truth.young + 2.0 * truth.toe + 1e-12;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (stress_with_toe(truth, middle) < stress ? low : high) = middle;
  }
  return low;
}

/// What the machine records. The last row before the break is at the strength exactly, but for
/// noise.
inline calib::RawTest record(const TensileTruth& truth) {
  std::mt19937 random(truth.seed);
  std::normal_distribution<double> normal;
  calib::RawTest raw;
  raw.specimen_id = "0038";
  raw.width = truth.width;
  raw.thickness = truth.thickness;
  raw.gauge_length = truth.gauge_length;
  const double first = strain_with_toe(truth, truth.preload / truth.area());
  const double last = strain_with_toe(truth, truth.strength);
  const int rows = static_cast<int>((last - first) / (truth.strain_rate * truth.sampling));
  const auto add = [&](double time, double strain, double stress) {
    raw.time.push_back(time);
    raw.force.push_back(stress * truth.area() + truth.force_noise * normal(random));
    raw.strain.push_back(strain - first + truth.strain_noise * normal(random));
    raw.extension.push_back((strain - first) * truth.gauge_length);
    raw.stress.push_back(raw.force.back() / truth.area());
  };
  const double step = (last - first) / rows;
  const int cycled = truth.cycles * truth.rows_per_cycle;
  for (int i = 0; i < cycled; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / truth.rows_per_cycle;
    const double strain = first + 0.5 * truth.cycle_part * (last - first) * (1.0 - std::cos(phase));
    add(i * truth.sampling, strain, stress_with_toe(truth, strain));
  }
  for (int i = 0; i <= rows; ++i)
    add((cycled + i) * truth.sampling, first + i * step, stress_with_toe(truth, first + i * step));
  for (int i = 1; i <= truth.rows_after_break; ++i)
    add((cycled + rows + i) * truth.sampling, last + i * step, 0.02 * truth.strength);
  return raw;
}

/// A file in a folder of its own, gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content, const std::string& name = "test.csv")
      : path_(folder_.write(name, content)) {}

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  ScratchFolder folder_;
  std::filesystem::path path_;
};

/// UTF-8 text in another encoding, as iconv names it.
inline std::string encoded(const std::string& utf8, const std::string& encoding) {
  const iconv_t converter = iconv_open(encoding.c_str(), "UTF-8");
  std::string in = utf8, out(4 * utf8.size() + 8, '\0');
  char *from = in.data(), *to = out.data();
  std::size_t from_left = in.size(), to_left = out.size();
  const std::size_t outcome = iconv(converter, &from, &from_left, &to, &to_left);
  iconv_close(converter);
  EXPECT_NE(outcome, static_cast<std::size_t>(-1)) << "not in " << encoding;
  out.resize(out.size() - to_left);
  return out;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

}  // namespace havers::test
