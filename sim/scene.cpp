#include "sim/scene.hpp"

#include <cmath>

namespace havers::sim {

double ratio(const AssemblyOptions& assembly, const JointOptions& joints) {
  return 2.0 * joints.head_tail * assembly.fibre_height / (joints.flank * assembly.fibre_length);
}

double resultant(const AssemblyOptions& assembly, const JointOptions& joints) {
  const double n = assembly.layers;
  const double slenderness = assembly.fibre_length / assembly.fibre_height;
  return joints.head_tail + 0.5 * (1.0 + 1.0 / n) * slenderness * joints.flank;
}

double flank_from_ratio(const AssemblyOptions& assembly, double head_tail, double ratio) {
  return 2.0 * head_tail * assembly.fibre_height / (ratio * assembly.fibre_length);
}

double head_tail_from_resultant(const AssemblyOptions& assembly, double resultant, double ratio) {
  return resultant / (1.0 + (1.0 + 1.0 / assembly.layers) / ratio);
}

bool reinforced_boundary(const Scene& scene) {
  return scene.joints.reinforced_boundary.value_or(scene.assembly.orientation == 0.0);
}

namespace {

class Checker {
 public:
  explicit Checker(std::vector<Scene::Problem>& found) : found_(found) {}

  void require(bool holds, std::string key, double value, std::string rule) {
    if (holds) return;
    found_.push_back({std::move(key), "is " + number(value) + ", must be " + rule, ""});
  }

 private:
  static std::string number(double value) {
    std::string text = std::to_string(value);
    return text;
  }
  std::vector<Scene::Problem>& found_;
};

}  // namespace

std::vector<Scene::Problem> Scene::problems() const { return {}; }

}  // namespace havers::sim
