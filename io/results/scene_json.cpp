#include <fmt/format.h>

#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {

nlohmann::json scene_json(const sim::Scene& scene) {
  sim::Scene copy =
      scene;  // keys are declared once, for reading and writing, and so ask for a mutable one
  nlohmann::json json = json_of(copy);
  // A scene cannot hold thresholds joint by joint; the joints.csv beside the result does.
  if (!scene.joints.thresholds.empty()) json["joints"]["thresholds_file"] = "joints.csv";
  return json;
}

// JSON's numbers, texts and truth values are TOML's as well.
std::string scene_toml(const sim::Scene& scene) {
  const nlohmann::json tables = scene_json(scene);
  std::string text;
  for (const auto& [table, keys] : tables.items()) {
    text += fmt::format("[{}]\n", table);
    for (const auto& [key, value] : keys.items())
      text += fmt::format("{} = {}\n", key, value.dump());
  }
  return text;
}

}  // namespace havers::io
