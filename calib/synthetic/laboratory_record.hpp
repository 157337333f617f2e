// A simulation dressed as the record a testing machine would have kept: synthetic tests with a
// known truth.
#pragma once

#include <cstdint>

#include "calib/experiment/raw_test.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {

/// The bar in the machine. The model gives stress against strain; the bar makes force and extension
/// of it.
struct Bar {
  double width = 4e-3;          ///< [m]
  double thickness = 2e-3;      ///< [m]
  double gauge_length = 25e-3;  ///< [m]

  [[nodiscard]] double area() const { return width * thickness; }  ///< [m²]
};

/// How the laboratory tests and records.
struct Laboratory {
  double crosshead_rate = 0.5e-3 / 60;  ///< [m/s]
  double sampling = 0.1;                ///< Time between rows. [s]
  double preload = 10.0;     ///< Force at the first row, where strain and extension are zeroed. [N]
  double toe_strain = 1e-4;  ///< Strain lost while the specimen settles in its grips. [-]
  double force_noise = 0.5;  ///< Standard deviation. [N]
  double strain_noise = 2e-6;  ///< Standard deviation. [-]
  double gain_error = 0.0;     ///< Of each channel's calibration, standard deviation. [-]
  int rows_after_break = 5;    ///< The machine stops so many rows after the parting.
  /// So long before the loading a second logger starts; its rows then mostly lie between the
  /// machine's. [rows]
  double logger_rows_before = 50.3;
};

/// ε̇ of a specimen: crosshead rate over gauge length. [1/s]
double strain_rate(const Bar& bar, const Laboratory& laboratory);

/// Whether a run is a test to record: trusted, and broken. One that reached the strain limit has no
/// end, a severed one no beginning.
bool is_test(const sim::Simulation& simulation);

/// Time, force, extension and strain as recorded, equations (Y1) to (Y3) of
/// calib/synthetic/README.md. Noise and gains are functions of seed, row and channel alone.
/// Precondition: the simulation `is_test`; all rates and sizes are positive.
RawTest record_test(const sim::Simulation& simulation, const Bar& bar, const Laboratory& laboratory,
                    std::uint64_t seed);

/// What the clock of a second logger shows at the first row of `record_test`. [s]
double logger_at_first_row(const sim::Simulation& simulation, const Bar& bar,
                           const Laboratory& laboratory);

/// Time and strain as a second logger records the gauge of the same test on a clock of its own
/// (Y4): with the gain of `record_test`, and noise of its own. Preconditions as there.
RawTest record_logger(const sim::Simulation& simulation, const Bar& bar,
                      const Laboratory& laboratory, std::uint64_t seed);

/// A seed for each specimen of a synthetic study; none of a fit's replicates has it.
std::uint64_t specimen_seed(std::uint64_t study_seed, std::uint64_t specimen);

/// Factor on a specimen's modulus, log-normal with mean 1 and coefficient of variation `cv`; 1 when
/// cv = 0.
double modulus_variation(std::uint64_t specimen_seed, double cv);

}  // namespace havers::calib
