#include "io/snapshots/snapshots.hpp"

namespace havers::io {
namespace {

// Keeps the first, and with an odd number the last.
void drop_every_second(std::vector<Snapshot>& held) {
  for (std::size_t i = 1; 2 * i < held.size(); ++i) held[i] = std::move(held[2 * i]);
  held.resize((held.size() + 1) / 2);
}

}  // namespace

SnapshotRecorder::SnapshotRecorder(int count) : count_(static_cast<std::size_t>(count)) {}

void SnapshotRecorder::record(const sim::Progress& progress) {
  if (progress.row <= row_) {  // of another run
    shown_ = 0;
    stride_ = 1;
    held_.clear();
  }
  row_ = progress.row;
  // Displacements are asked for only where they are kept: in the quasi-static limit they cost a
  // solve.
  if (count_ == 0 || shown_++ % stride_ != 0) return;
  held_.push_back({progress.row, progress.displacements(), progress.joints()});
  // What remains is what the doubled stride would have kept from the beginning.
  if (held_.size() < 2 * count_ + 1) return;
  drop_every_second(held_);
  stride_ *= 2;
}

void SnapshotRecorder::finish(const sim::Simulation& simulation) {
  if (count_ == 0 || simulation.displacements.size() == 0) return;
  // The last row is held once, whether or not `record` has seen it.
  const std::size_t last = simulation.curve.size() - 1;
  if (!held_.empty() && held_.back().row == last) held_.pop_back();
  held_.push_back({last, simulation.displacements, simulation.joints});
}

std::vector<Snapshot> SnapshotRecorder::chosen() const {
  if (held_.size() <= count_) return held_;
  std::vector<Snapshot> spread;
  // Evenly spread over those held, from the first; the last is added below.
  for (std::size_t i = 0; i + 1 < count_; ++i)
    spread.push_back(held_[i * (held_.size() - 1) / (count_ - 1)]);
  spread.push_back(held_.back());
  return spread;
}

}  // namespace havers::io
