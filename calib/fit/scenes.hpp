// From a specimen to the scenes that simulate it.
#pragma once

#include <cstdint>
#include <string_view>

#include "calib/study/study.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

/// The model of one specimen, before any parameter is set.
struct SpecimenModel {
  sim::Scene scene;             ///< Orientation, strain rate and scatter are the specimen's.
  double porosity = 0.0;        ///< NaN where unknown. [-]
  bool scatter_told = false;    ///< By its porosity; otherwise it is that of the study's model.
  double modulus_factor = 1.0;  ///< On young_GPa, by porosity (K4). [-]
  double scatter_standard_error = 0.0;  ///< Of the scatter that the sections give (K3). [-]
  double missing_standard_error = 0.0;  ///< Of the part of joints that is missing (K5). [-]
  double modulus_standard_error = 0.0;  ///< Of `modulus_factor`, relative. [-]
};

/// Porosity, scatter or missing joints (K5), rate and orientation of specimen `s` set in the
/// study's model.
SpecimenModel model_of(const Study& study, std::size_t s);

/// The same with other laws of porosity.
SpecimenModel model_of(const Study& study, std::size_t s, const PorosityOptions& laws);

/// Seed of a replicate: of the study's seed, the specimen's id and the replicate alone, so that a
/// change of parameters, or one more specimen, never reshuffles the joints (common random numbers).
std::uint64_t replicate_seed(std::uint64_t study_seed, std::string_view id, int replicate);

}  // namespace havers::calib
