// Sweeps whose outcome is known, made without the simulator.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calib/sweep/measure.hpp"

namespace havers::test {

/// Points and runs of a plan of one strength: value(point, k) for run k of each point.
struct KnownSweep {
  calib::SweepPlan plan;
  std::vector<calib::SweepPoint> points;
  std::vector<calib::SweepRun> runs;

  KnownSweep(std::vector<calib::SweepKey> keys, int seeds,
             const std::function<double(const calib::SweepPoint&, int)>& value,
             calib::Sampling sampling = calib::Sampling::grid) {
    plan.sampling = sampling;
    plan.keys = std::move(keys);
    plan.seeds = seeds;
    for (const auto& values : calib::points_of(plan)) {
      calib::SweepPoint point;
      point.values = values;
      for (const std::string& text : values) point.numbers.push_back(std::stod(text));
      points.push_back(point);
    }
    for (std::size_t point = 0; point < points.size(); ++point)
      for (int k = 0; k < seeds; ++k) {
        calib::SweepRun run;
        run.point = point;
        run.failed = false;
        run.broke = true;
        run.measures.fill(value(points[point], k));
        runs.push_back(run);
      }
  }
};

/// Deviations that add up to zero over 20 runs, of standard deviation close to 1.
inline double deviation(int k) {
  return 1.7 * (k % 20 - 9.5) / 10.0;
}

}  // namespace havers::test
