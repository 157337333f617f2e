// A known specimen recorded by two machines with a clock each, whose offset and rate are known.
#pragma once

#include <random>

#include "calib/experiment/raw_test.hpp"

namespace havers::test {

struct Clocks {
  double offset = 7.3;  // machine's time when the logger's shows 0 [s]
  double rate = 1.0005;
};

// Idle, loading with a hold, the break, idle: what both recorders see. [s], [-]
inline double strain_at(double time) {
  if (time < 10.0 || time > 60.0) return 0.0;
  if (time < 30.0) return 1e-4 * (time - 10.0);
  if (time < 35.0) return 2e-3;
  return 2e-3 + 1e-4 * (time - 35.0);
}

inline constexpr double young = 13e9, area = 8e-6;

inline calib::RawTest machine_record(unsigned seed, double noise = 0.3) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  calib::RawTest raw;
  raw.area = area;
  for (int i = 0; i < 700; ++i) {
    raw.time.push_back(0.1 * i);
    raw.force.push_back(young * area * strain_at(raw.time.back()) + normal(random));
  }
  return raw;
}

inline calib::RawTest logger_record(const Clocks& clocks, unsigned seed, double from = -5.0,
                                    double to = 68.0) {
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> normal(0.0, 2e-6);
  calib::RawTest raw;
  const int rows = static_cast<int>((to - from) / 0.073);
  for (int i = 0; i < rows; ++i) {
    const double machine_time = from + 0.073 * i;
    raw.time.push_back((machine_time - clocks.offset) / clocks.rate);
    raw.strain.push_back(strain_at(machine_time) + normal(random));
  }
  return raw;
}

}  // namespace havers::test
