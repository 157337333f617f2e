#include "io/input_error.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {
namespace {

Snapshot moment(int row, const sim::Progress& progress) {
  return {.row = row, .displacements = progress.displacements, .joints = progress.joints};
}

void drop_every_second(std::vector<Snapshot>& held) {
  for (std::size_t i = 1; 2 * i < held.size(); ++i) held[i] = std::move(held[2 * i]);
  held.resize((held.size() + 1) / 2);
}

}  // namespace

SnapshotRecorder::SnapshotRecorder(int count) : count_(static_cast<std::size_t>(count)) {
  if (count > 0 && !snapshots_available())
    throw InputError("output.snapshots", "this build writes no snapshots for ParaView",
                     "apt-get install libvtk9-dev and build again, or set output.snapshots = 0");
}

void SnapshotRecorder::record(const sim::Progress& progress) {
  if (count_ == 0) return;
  const int row = rows_++;
  last_ = moment(row, progress);
  if (row % stride_ != 0) return;
  held_.push_back(last_);
  if (held_.size() < 2 * count_ + 1) return;
  drop_every_second(held_);
  stride_ *= 2;
}

std::vector<Snapshot> SnapshotRecorder::chosen() const {
  if (rows_ == 0 || count_ == 0) return {};
  std::vector<Snapshot> all = held_;
  if (all.back().row != last_.row) all.push_back(last_);
  if (all.size() <= count_) return all;
  std::vector<Snapshot> spread;
  for (std::size_t i = 0; i + 1 < count_; ++i)
    spread.push_back(all[i * (all.size() - 1) / (count_ - 1)]);
  spread.push_back(all.back());
  return spread;
}

}  // namespace havers::io
