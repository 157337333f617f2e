#include "calib/synthetic/laboratory_record.hpp"

#include <Random123/philox.h>

#include <Random123/boxmuller.hpp>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/outcome.hpp"

namespace havers::calib {
namespace {

// What a random number is for; with the seed and the row it names the number.
enum class Draw : std::uint64_t { noise = 1, seed = 2, modulus = 3, gain = 4, logger = 5 };

// A function of its arguments alone, whatever was drawn before.
r123::Philox2x64::ctr_type draw(std::uint64_t seed, std::uint64_t row, Draw purpose) {
  return r123::Philox2x64()({{row, static_cast<std::uint64_t>(purpose)}}, {{seed}});
}

r123::double2 gauss_pair(std::uint64_t seed, std::uint64_t row, Draw purpose) {
  const auto bits = draw(seed, row, purpose);
  return r123::boxmuller(bits[0], bits[1]);
}

// (Y1) While the specimen settles, the gauge moves and the specimen does not.
double strain_of_specimen(double gauge, double toe) {
  return toe > 0.0 ? gauge + toe * std::expm1(-gauge / toe) : gauge;
}

// The inverse of (Y1) by Newton's method, from above: (Y1) is convex, so that no step goes too far.
// 0 where the specimen is not strained.
double strain_of_gauge(double specimen, double toe) {
  if (toe <= 0.0 || specimen <= 0.0) return std::max(specimen, 0.0);
  double gauge = specimen + toe;
  for (double change = toe; std::abs(change) > 1e-9 * gauge;) {
    const double next =
        gauge - (strain_of_specimen(gauge, toe) - specimen) / -std::expm1(-gauge / toe);
    change = next - gauge;
    gauge = next;
  }
  return gauge;
}

// e₀ of (Y2).
double start_of_record(const sim::Simulation& simulation, const Bar& bar,
                       const Laboratory& laboratory) {
  return strain_of_gauge(laboratory.preload / (bar.area() * simulation.modulus),
                         laboratory.toe_strain);
}

}  // namespace

double strain_rate(const Bar& bar, const Laboratory& laboratory) {
  return laboratory.crosshead_rate / bar.gauge_length;
}

bool is_test(const sim::Simulation& simulation) {
  return simulation.trusted() && simulation.status == sim::SimulationStatus::broken;
}

RawTest record_test(const sim::Simulation& simulation, const Bar& bar, const Laboratory& laboratory,
                    std::uint64_t seed) {
  assert(!simulation.curve.empty() && simulation.modulus > 0.0);
  assert(bar.area() > 0.0 && strain_rate(bar, laboratory) > 0.0 && laboratory.sampling > 0.0);
  RawTest test;
  test.width = bar.width;
  test.thickness = bar.thickness;
  test.gauge_length = bar.gauge_length;

  // (Y2) The record starts, and strain and extension are zeroed, when the force reaches the
  // preload.
  const double start = start_of_record(simulation, bar, laboratory);
  // One draw for a test: a calibration errs alike in all rows.
  const auto gain = gauss_pair(seed, 0, Draw::gain);
  const double force_gain = 1.0 + laboratory.gain_error * gain.x;
  const double strain_gain = 1.0 + laboratory.gain_error * gain.y;
  for (int row = 0, after_break = 0; after_break < laboratory.rows_after_break; ++row) {
    const double time = row * laboratory.sampling;
    const double since_start = strain_rate(bar, laboratory) * time;
    const double strain = strain_of_specimen(start + since_start, laboratory.toe_strain);
    const auto stress = sim::stress_at(simulation.curve, strain);
    const auto noise = gauss_pair(seed, static_cast<std::uint64_t>(row), Draw::noise);
    // (Y3) A crosshead never goes back: the curve is followed where it first reaches a strain.
    // Parted, the halves carry nothing and the gauge springs back.
    test.time.push_back(time);
    test.extension.push_back(laboratory.crosshead_rate * time);
    test.force.push_back(force_gain * bar.area() * stress.value_or(0.0) +
                         laboratory.force_noise * noise.x);
    test.strain.push_back(strain_gain * (stress ? since_start : -start) +
                          laboratory.strain_noise * noise.y);
    if (!stress) ++after_break;
  }
  return test;
}

double logger_at_first_row(const sim::Simulation& simulation, const Bar& bar,
                           const Laboratory& laboratory) {
  return laboratory.logger_rows_before * laboratory.sampling +
         start_of_record(simulation, bar, laboratory) / strain_rate(bar, laboratory);
}

RawTest record_logger(const sim::Simulation& simulation, const Bar& bar,
                      const Laboratory& laboratory, std::uint64_t seed) {
  assert(!simulation.curve.empty() && simulation.modulus > 0.0);
  assert(bar.area() > 0.0 && strain_rate(bar, laboratory) > 0.0 && laboratory.sampling > 0.0);
  RawTest logger;
  const double gain = 1.0 + laboratory.gain_error * gauss_pair(seed, 0, Draw::gain).y;
  for (int row = 0, after_break = 0; after_break < laboratory.rows_after_break; ++row) {
    // (Y4) Slack until the loading begins, and after the break again.
    const double loaded = (row - laboratory.logger_rows_before) * laboratory.sampling;
    const double gauge = std::max(strain_rate(bar, laboratory) * loaded, 0.0);
    const bool parted =
        !sim::stress_at(simulation.curve, strain_of_specimen(gauge, laboratory.toe_strain));
    logger.time.push_back(row * laboratory.sampling);
    logger.strain.push_back((parted ? 0.0 : gain * gauge) +
                            laboratory.strain_noise *
                                gauss_pair(seed, static_cast<std::uint64_t>(row), Draw::logger).x);
    if (parted) ++after_break;
  }
  return logger;
}

std::uint64_t specimen_seed(std::uint64_t study_seed, std::uint64_t specimen) {
  return draw(study_seed, specimen, Draw::seed)[0];
}

double modulus_variation(std::uint64_t specimen_seed, double cv) {
  // Standard deviation of the logarithm that makes this coefficient of variation; the shift below
  // keeps the mean at 1.
  const double sd = std::sqrt(std::log1p(cv * cv));
  return std::exp(sd * gauss_pair(specimen_seed, 0, Draw::modulus).x - 0.5 * sd * sd);
}

}  // namespace havers::calib
