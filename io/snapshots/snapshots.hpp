// The assembly at moments of a run, for ParaView (.vtu).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "sim/simulation.hpp"

namespace havers::io {

/// Whether this build can write .vtu files.
bool snapshots_available();

/// One moment of a run.
struct Snapshot {
  std::size_t row = 0;                    ///< Of the curve, from 0.
  Eigen::VectorXd displacements;          ///< x and y of every node. [m]
  std::vector<sim::JointOutcome> joints;  ///< In the order of Assembly::joints.
};

/// Keeps `count` moments spread evenly over a run whose length is not known beforehand: every k-th
/// row, and k doubles whenever twice as many are held as asked for.
class SnapshotRecorder {
 public:
  explicit SnapshotRecorder(int count);

  /// To be called for every row that a run shows, in order. A row of an earlier time begins another
  /// run, as when a chosen step is halved; what the one before left is dropped.
  void record(const sim::Progress& progress);

  /// To be called once after the run: its last state is the last moment.
  void finish(const sim::Simulation& simulation);

  /// The moments, the first that was shown and the last row among them (one: the last).
  [[nodiscard]] std::vector<Snapshot> chosen() const;

 private:
  std::size_t count_;
  std::size_t shown_ = 0, stride_ = 1;
  std::size_t row_ = 0;  // the last one seen
  std::vector<Snapshot> held_;
};

/// Writes the triangles of the fibres and the joints as lines, both displaced by the point data
/// `displacement` only when ParaView's "Warp By Vector" is applied. Cell data: `kind` (0 fibre, 1
/// head_tail, 2 flank), `broken`, `gap_m`.
/// @throws InputError when VTK is not built in or the file cannot be written.
void write_vtu(const std::filesystem::path& file, const sim::Assembly& assembly,
               const Eigen::VectorXd& displacements, const std::vector<sim::JointOutcome>& joints);

}  // namespace havers::io
