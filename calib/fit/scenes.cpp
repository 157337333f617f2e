#include "calib/fit/scenes.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

// NaN where neither sections nor the study tell it.
SpecimenPorosity porosity_of(const Specimen& specimen) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!specimen.sections.empty()) return pool_sections(specimen.sections);
  return {.porosity = specimen.porosity.value_or(unknown), .window_sd = unknown};
}

}  // namespace

SpecimenModel model_of(const Study& study, std::size_t s) {
  return model_of(study, s, study.porosity);
}

SpecimenModel model_of(const Study& study, std::size_t s, const PorosityOptions& laws) {
  const auto& specimen = study.specimens[s];
  SpecimenModel model{.scene = study.model};
  model.scene.assembly.orientation = specimen.orientation;
  if (specimen.test.strain_rate > 0.0) model.scene.loading.strain_rate = specimen.test.strain_rate;

  const SpecimenPorosity porosity = porosity_of(specimen);
  model.porosity = porosity.porosity;
  if (!std::isfinite(porosity.porosity)) return model;
  const auto known = [](double error) { return std::isfinite(error) ? error : 0.0; };
  model.modulus_factor = modulus_factor(porosity, laws);
  if (laws.to_modulus == ToModulus::power)  // (K4)
    model.modulus_standard_error =
        known(laws.modulus_exponent * porosity.porosity_standard_error / (1.0 - porosity.porosity));
  const double scatter = scatter_of(porosity, laws);
  if (!std::isfinite(scatter)) return model;  // the study's model has one
  // (K5) Pores larger than a window take joints away and leave the others' thresholds alone.
  if (laws.to_scatter == ToScatter::window && removes_joints(porosity)) {
    model.scene.joints.missing = porosity.porosity;
    model.missing_standard_error = known(porosity.porosity_standard_error);
    return model;
  }
  model.scatter_told = true;
  model.scene.joints.scatter = scatter;
  model.scatter_standard_error = known(scatter_standard_error(porosity, laws));
  return model;
}

std::uint64_t replicate_seed(std::uint64_t study_seed, std::string_view id, int replicate) {
  // (F2) The id's hash and the replicate are the counter, the study's seed is the key.
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32U); };
  const r123::Philox4x32::ctr_type counter{
      {low(hash), high(hash), static_cast<std::uint32_t>(replicate), 0U}};
  const r123::Philox4x32::key_type key{{low(study_seed), high(study_seed)}};
  return r123::Philox4x32()(counter, key)[0];
}

}  // namespace havers::calib
