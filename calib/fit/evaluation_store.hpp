// Finished simulations, kept: what calib asks of a store, whatever it is made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace havers::calib {

/// What a calibration keeps of a simulation.
struct Response {
  bool failed = true;     ///< No usable answer.
  bool broke = false;     ///< false: the strain limit came first, the strength is a lower bound.
  std::string why;        ///< It failed; else what it is to be trusted but for, if anything.
  double modulus = 0.0;   ///< 0 where it is not known (a shock's). [Pa]
  double strength = 0.0;  ///< In time without waves that ring, as a machine sees it. [Pa]
  double failure_strain = 0.0;  ///< [-]
  std::vector<double> strain;   ///< Curve. [-]
  std::vector<double> stress;   ///< Curve. [Pa]
};

/// Keyed by a text that names everything the response depends on. Safe to call from several
/// threads. Both calls may throw, where a disk is full or a file locked: no fault of a simulation.
class EvaluationStore {
 public:
  virtual ~EvaluationStore() = default;
  /// Nothing where the key is not kept.
  virtual std::optional<Response> find(const std::string& key) = 0;
  /// Failed responses too: the same scene would fail again.
  virtual void save(const std::string& key, const Response& response) = 0;
};

}  // namespace havers::calib
