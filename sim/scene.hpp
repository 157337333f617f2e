// One simulation, as its user describes it: plain data in SI units, with the defaults of a scene
// file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace havers::sim {

/// The fibre pattern and the rectangle it fills. Section 1 of sim/README.md.
struct AssemblyOptions {
  int layers = 30;               ///< N, layers of fibres across the height at 0°.
  int fibres = 21;               ///< n, fibres along a layer.
  double fibre_length = 100e-6;  ///< L. [m]
  double fibre_height = 10e-6;   ///< l. [m]
  double orientation = 0.0;      ///< θ, angle between fibre axis and loading axis. [rad]
  int refinement = 1;            ///< k: a whole fibre has 8 k² T3; 1, 2 or 4.

  [[nodiscard]] double width() const { return fibres * fibre_length; }   ///< W. [m]
  [[nodiscard]] double height() const { return layers * fibre_height; }  ///< H. [m]
};

/// Whether stress or strain is zero out of the plane.
enum class Plane { stress, strain };

/// The material of every fibre. Section 2.
struct Material {
  double young = 13e9;      ///< E. [Pa]
  double poisson = 0.33;    ///< ν. [-]
  double density = 2000.0;  ///< ρ. [kg/m³]
  Plane plane = Plane::stress;
  double viscosity = 0.0;  ///< τ of the damping matrix τK. [s]
  /// Modulus of every second layer relative to E, at most 1: lamellae of bone alternate. [-]
  double layer_contrast = 1.0;
};

/// Young's modulus of a layer of fibres, counted from the lower left corner. [Pa]
double young_of_layer(const Material& material, int layer);

/// Plane strain is plane stress with ν/(1−ν) for ν, the lateral contraction under uniaxial stress
/// in the plane, and with E/(1−ν²) for E. [-]
double lateral_contraction(const Material& material);
double plane_stiffening(const Material& material);  ///< 1, or 1/(1−ν²).

/// c = √(E/ρ). [m/s]
double wave_speed(const Material& material);

/// Distribution of the threshold factor w, of mean 1 and standard deviation d/√12 (M8).
enum class Distribution { uniform, weibull, lognormal };

/// Threshold of one joint, force per unit thickness.
struct Threshold {
  double normal = 0.0;   ///< f_N, tension; 0: the joint is missing, broken from the start. [N/m]
  double tangent = 0.0;  ///< f_T, shear at R_N = 0. [N/m]
};

/// Whether a joint is not there at all: both thresholds are 0.
bool is_missing(const Threshold& threshold);

/// Strength of the joints. Sections 3 and 4.
struct JointOptions {
  double head_tail = 50e6;                ///< σ₁ = f₁/l. [Pa]
  double flank = 10e6;                    ///< σ₂ = f₂/(L/2). [Pa]
  std::optional<double> head_tail_shear;  ///< f_T of a head-tail joint over l; default f₂/l. [Pa]
  std::optional<double> flank_tension;  ///< f_N of a flank joint over L/2; default f₁/(L/2). [Pa]
  double scatter = 0.2;                 ///< d ∈ [0, 2), length of the interval of w. [-]
  Distribution distribution = Distribution::uniform;
  double missing = 0.0;                     ///< Fraction of joints that pores take away (M13). [-]
  double friction = 0.3;                    ///< μ_f of broken joints. [-]
  std::optional<bool> reinforced_boundary;  ///< Default: on at 0° only.
  std::uint64_t seed = 1;                   ///< Of all draws.
  std::vector<Threshold> thresholds;        ///< One per joint instead of a draw; empty: draw.
};

/// Whether joints are, or may be, missing from the start.
bool some_are_missing(const JointOptions& joints);

/// Top and bottom tied to each other, or free of forces.
enum class Lateral { periodic, free };
/// The velocity a run in time starts with: that of uniform stretching, or none, which is a shock.
enum class Start { uniform, rest };

/// Loading and boundary. Section 5.
struct Loading {
  double strain_rate = 1000.0;  ///< ε̇. [1/s]
  Lateral lateral = Lateral::periodic;
  Start start = Start::uniform;
  double max_strain = 0.05;  ///< The run ends with the row that reaches it. [-]
  double end_fraction =
      0.3;  ///< It ends when both sides carry less than this part of the strength. [-]
};

/// automatic: the limit where inertia is small enough (M12).
enum class Regime { automatic, dynamic, quasi_static };
/// automatic: the active set.
enum class ContactMethod { automatic, active_set, gauss_seidel };

/// How the simulation is computed.
struct SolverOptions {
  Regime regime = Regime::automatic;
  std::optional<double> step;   ///< h; omitted: chosen, and said. [s]
  bool leap = false;            ///< With a given step: as chosen ones do (`knows_first_break`).
  double step_accuracy = 1e-3;  ///< Of failure strain and strength by the chosen step. [-]
  ContactMethod contact = ContactMethod::automatic;
  double tolerance = 1e-8;     ///< Largest relative residual (M11). [-]
  int max_iterations = 10000;  ///< Sweeps of Gauss-Seidel in one step.
  bool leave_out = true;       ///< false: nothing is left out (section 7), for comparison.
};

/// Everything one simulation needs. Equal scenes give equal results, bit for bit.
struct Scene {
  AssemblyOptions assembly;
  Material material;
  JointOptions joints;
  Loading loading;
  SolverOptions solver;

  /// A complaint: the key of a scene file it is about ("joints.scatter"), what is wrong, what to
  /// do.
  struct Problem {
    std::string key, what, hint;
  };
  /// What is wrong with the scene; empty when it can be simulated.
  [[nodiscard]] std::vector<Problem> problems() const;
  /// What can be simulated and is hardly meant, as of a value in another unit; a sentence each.
  [[nodiscard]] std::vector<std::string> doubts() const;
};

/// r = f₁/f₂ (M9). [-]
double ratio(const AssemblyOptions& assembly, const JointOptions& joints);

/// Σ_res = σ₁ + ½(1 + 1/N)(L/l)σ₂ (M9). [Pa]
double resultant(const AssemblyOptions& assembly, const JointOptions& joints);

/// The flank stress σ₂ that gives the ratio r at head-tail stress σ₁ (M9). [Pa]
double flank_from_ratio(const AssemblyOptions& assembly, double head_tail, double ratio);

/// The head-tail stress σ₁ of resultant Σ_res and ratio r (M9). [Pa]
double head_tail_from_resultant(const AssemblyOptions& assembly, double resultant, double ratio);

/// Whether the outer layers' head-tail joints carry the missing flanks' force. Section 4.
bool reinforced_boundary(const Scene& scene);

}  // namespace havers::sim
