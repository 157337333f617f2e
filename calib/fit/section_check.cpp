#include "calib/fit/section_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace havers::calib {
namespace {

// "A1 (A1_s1.png, A1_s2.png)"; empty where there is none.
template <class Doubt>
std::string sections_in_doubt(const Specimen& specimen, const Doubt& in_doubt) {
  std::vector<std::string> files;
  for (const SectionPorosity& section : specimen.sections)
    if (in_doubt(section)) files.push_back(section.file.substr(section.file.rfind('/') + 1));
  return files.empty() ? "" : fmt::format("{} ({})", specimen.id, fmt::join(files, ", "));
}

// What the specimens' porosity does not tell of what a study takes from it. Names of specimens:
// with sections in doubt (I17), with pores that no canal has (K2), without a scatter or a modulus
// of their own.
struct Untold {
  std::vector<std::string> doubted, scaled, scatter, modulus;
  bool any = false;  // has sections, or tells one of these
};

Untold untold_of(const FitProblem& problem) {
  const PorosityOptions& laws = problem.study.porosity;
  const bool searched = std::ranges::any_of(
      problem.unknowns, [](const Unknown& unknown) { return unknown.info->name == "scatter"; });
  Untold found;
  // Specimens kept for validation count too: their predictions take as much from porosity.
  for (std::size_t s = 0; s < problem.models.size(); ++s) {
    const Specimen& specimen = problem.study.specimens[s];
    const SpecimenModel& model = problem.models[s];
    const bool known = std::isfinite(model.porosity);
    const auto collect = [&](std::vector<std::string>& all, const auto& in_doubt) {
      if (std::string doubt = sections_in_doubt(specimen, in_doubt); !doubt.empty())
        all.push_back(std::move(doubt));
    };
    collect(found.doubted, [](const SectionPorosity& section) { return section.doubtful; });
    if (laws.to_scatter == ToScatter::window)
      collect(found.scaled, [](const SectionPorosity& one) { return !pores_may_be_canals(one); });
    if (laws.to_scatter != ToScatter::none && !model.scatter_told && !searched)
      found.scatter.push_back(specimen.id);
    if (laws.to_modulus != ToModulus::none && !known) found.modulus.push_back(specimen.id);
    found.any = found.any || !specimen.sections.empty() || model.scatter_told ||
                (laws.to_modulus != ToModulus::none && known);
  }
  return found;
}

}  // namespace

Check check_sections(const FitProblem& problem) {
  constexpr const char* name = "sections tell porosity";
  const PorosityOptions& laws = problem.study.porosity;
  if (laws.to_scatter == ToScatter::none && laws.to_modulus == ToModulus::none)
    return not_checked(name, "porosity changes nothing in the model.");
  const Untold found = untold_of(problem);
  const double scatter = problem.study.model.joints.scatter;
  if (!found.any)
    return not_checked(
        name, fmt::format("no specimen has sections. Unless it is fitted, the scatter is taken to "
                          "be {:g} (model.joints.scatter), for which strengths hold.",
                          scatter));
  std::vector<std::string> sentences;
  if (!found.doubted.empty())
    sentences.push_back(fmt::format(
        "Images leave the porosity of sections in doubt, as their warnings say: of {}. What the "
        "model takes from it may be off by more than any error here says. Mend what the warnings "
        "name, or leave these sections out.",
        fmt::join(found.doubted, ", ")));
  if (!found.scaled.empty())
    sentences.push_back(fmt::format(
        "Pores are too narrow or too wide for canals in bone (10 to 500 µm) in sections of {}, and "
        "the scatter that the model takes from them goes with their size: is pixel_size_um right?",
        fmt::join(found.scaled, ", ")));
  if (!found.scatter.empty())
    sentences.push_back(
        fmt::format("Nothing tells the scatter of {}: it is taken to be {:g} "
                    "(model.joints.scatter), without an error.",
                    fmt::join(found.scatter, ", "), scatter));
  if (!found.modulus.empty())
    sentences.push_back(
        fmt::format("No porosity is known of {}: the modulus is taken for that of "
                    "bone without pores.",
                    fmt::join(found.modulus, ", ")));
  if (sentences.empty())
    return {name, Outcome::pass, "Of every specimen the porosity is known, and none is in doubt."};
  return {name, Outcome::warn, fmt::format("{}", fmt::join(sentences, " "))};
}

}  // namespace havers::calib
