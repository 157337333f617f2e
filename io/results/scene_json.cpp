#include <fmt/format.h>

#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {
namespace {

nlohmann::json tables_of_scene(const sim::Scene& scene) {
  nlohmann::json json = json_of(scene);
  // A scene cannot hold thresholds joint by joint; the joints.csv beside the result does.
  if (!scene.joints.thresholds.empty()) json["joints"]["thresholds_file"] = "joints.csv";
  return json;
}

}  // namespace

nlohmann::json scene_json(const sim::Scene& scene) {
  nlohmann::json json = tables_of_scene(scene);
  json["joints"]["reinforced_boundary"] = sim::reinforced_boundary(scene);
  return json;
}

// JSON's numbers, texts and truth values are TOML's as well. What was not set stays so:
// reinforced_boundary goes with the angle, which --set may turn.
std::string scene_toml(const sim::Scene& scene) {
  const nlohmann::json tables = tables_of_scene(scene);
  std::string text;
  for (const auto& [table, keys] : tables.items()) {
    text += fmt::format("[{}]\n", table);
    for (const auto& [key, value] : keys.items())
      text += fmt::format("{} = {}\n", key, value.dump());
  }
  return text;
}

}  // namespace havers::io
