// A scene file is the tables of a scene (scene_tables.hpp) and [output], which is no part of the
// model.
#include "io/config/read_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/config/file_kind.hpp"
#include "io/config/scene_tables.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {

SceneFile read_scene(const std::filesystem::path& file, const Overrides& overrides,
                     Snapshots snapshots) {
  ConfigFile config(file, overrides);
  TableReader top = config.top();
  require_kind(FileKind::scene, top, file);
  SceneFile read;
  read_scene_tables(top, read.scene);

  TableReader output = top.table("output");
  output.key("snapshots", read.snapshots);
  output.require(read.snapshots >= 0, "snapshots", read.snapshots, "0 or more");
  if (read.snapshots > 0 && snapshots == Snapshots::written && !snapshots_available())
    output.complain("snapshots", "this build writes no snapshots for ParaView",
                    "apt-get install libvtk9-dev and build again, or set output.snapshots = 0");

  // Thresholds from a file are not drawn, so these keys have no effect. That is a warning only, as
  // the scene can be run.
  if (TableReader joints = top.table("joints"); joints.has("thresholds_file"))
    for (const char* const key : {"seed", "scatter", "distribution", "missing"})
      if (joints.has(key))
        read.warnings.push_back(fmt::format(
            "joints.{} changes nothing: thresholds_file gives those of every joint", key));

  // Only a scene that can be simulated is asked for doubts.
  config.finish();
  std::ranges::move(read.scene.doubts(), std::back_inserter(read.warnings));
  read.inputs = config.inputs();
  return read;
}

}  // namespace havers::io
