// A tensile test as the machine recorded it, in SI units. Filled by io, reduced by reduce_test.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace havers::calib {

/// A correction that was applied, for the report: what, and by how much.
struct Correction {
  std::string what;    ///< "toe", "preload", "cut after break", ...
  std::string detail;  ///< With number and unit.
};

/// Channels of equal length; an empty one was not recorded.
struct RawTest {
  std::string specimen_id;        ///< As the file names it; may be empty.
  std::vector<double> time;       ///< [s]
  std::vector<double> force;      ///< Tension positive. [N]
  std::vector<double> extension;  ///< Of the crosshead. [m]
  std::vector<double> strain;     ///< Gauge or extensometer, or the machine's own. [-]
  std::vector<double>
      stress;  ///< As the machine computed it; used only where force or area is unknown. [Pa]
  std::vector<double> volts;                  ///< Of a gauge whose factor is not known yet. [V]
  std::vector<double> load_volts;             ///< Of a load cell whose factor is not known yet. [V]
  std::optional<double> width, thickness;     ///< Of the specimen. [m]
  std::optional<double> area;                 ///< Used where width or thickness is unknown. [m²]
  std::optional<double> gauge_length;         ///< [m]
  std::optional<double> extensometer_length;  ///< Where it is not that of the gauge length. [m]
  bool crosshead_strain = false;        ///< The strain is the crosshead's by its column's name.
  bool fitted_strain = false;           ///< It is a gauge's, fitted in volts to what it was (X19).
  bool load_turned = false;             ///< The load was read negative, and turned (X22).
  std::vector<Correction> corrections;  ///< What was done before the reduction.
  std::vector<std::string> warnings;    ///< What the reader noticed, a sentence each.

  /// The channel that tells how far the loading is; empty where none does.
  [[nodiscard]] const std::vector<double>& load() const {
    return !force.empty() ? force : !stress.empty() ? stress : load_volts;
  }
  [[nodiscard]] std::size_t rows() const { return load().empty() ? time.size() : load().size(); }
};

}  // namespace havers::calib
