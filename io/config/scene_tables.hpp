// The tables of a scene, at the top of a scene file and under [model] of a study.
#pragma once

#include "io/config/table_reader.hpp"
#include "sim/scene.hpp"

namespace havers::io {

/// Reads [assembly], [material], [joints], [loading] and [solver] over the scene's defaults and
/// complains about every value that cannot be.
void read_scene_tables(TableReader& tables, sim::Scene& scene);

}  // namespace havers::io
