// Doubts that arise only from several specimens, or from the study together with its files: the
// reader of a single file cannot have them.
#include "cli/loaded_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "calib/fit/calibration.hpp"
#include "calib/porosity/scatter_map.hpp"

namespace havers::cli {

void doubt_specimens(const std::vector<io::SpecimenFiles>& specimens, LoadedStudy& loaded) {
  std::map<std::pair<std::filesystem::path, std::optional<std::filesystem::path>>, std::string>
      owners;  // of sections under their masks
  for (const io::SpecimenFiles& files : specimens) {
    if (!files.orientation)
      loaded.notes.push_back(fmt::format(
          "specimen {} has no orientation_deg: 0 is taken, fibres along the load", files.id));
    std::set<std::filesystem::path> sections;
    for (const std::filesystem::path& section : files.sections) {
      if (!sections.insert(section).second)
        loaded.notes.push_back(fmt::format("specimen {} lists section {} again: it counts twice",
                                           files.id, section.string()));
      const std::string& owner = owners.try_emplace({section, files.mask}, files.id).first->second;
      if (owner != files.id)
        loaded.notes.push_back(fmt::format("specimens {} and {} have the same section, {}", owner,
                                           files.id, section.string()));
    }
  }
}

namespace {

// Whatever the study calls a test in its file; a logger's file holds one.
void doubt_shared_tests(const std::vector<io::SpecimenFiles>& specimens,
                        const std::vector<OwnWords>& own, LoadedStudy& loaded) {
  std::map<std::pair<std::filesystem::path, std::size_t>, const io::SpecimenFiles*> tests;
  std::map<std::filesystem::path, std::string> gauges;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const io::SpecimenFiles& files = specimens[i];
    if (own[i].number == 0) continue;
    const auto [earlier, fresh] =
        tests.try_emplace({std::filesystem::weakly_canonical(files.test), own[i].number}, &files);
    if (!fresh)
      loaded.notes.push_back(fmt::format("specimens {} and {} have the same test, {}: {}",
                                         earlier->second->id, files.id, files.test.string(),
                                         earlier->second->use == files.use
                                             ? "it counts twice"
                                             : "the fit sees what is to test it"));
    if (!files.gauge) continue;
    const auto [owner, alone] =
        gauges.try_emplace(std::filesystem::weakly_canonical(*files.gauge), files.id);
    if (!alone)
      loaded.notes.push_back(
          fmt::format("specimens {} and {} have the same gauge, {}: is it of both tests?",
                      owner->second, files.id, files.gauge->string()));
  }
}

}  // namespace

void doubt_tests(const std::vector<io::SpecimenFiles>& specimens, const std::vector<OwnWords>& own,
                 LoadedStudy& loaded) {
  doubt_shared_tests(specimens, own, loaded);
  const auto doubt = [&](const std::filesystem::path& file, const std::string& named,
                         const std::string& id) {
    if (named != id &&
        std::ranges::find(specimens, named, &io::SpecimenFiles::id) != specimens.end())
      loaded.notes.push_back(fmt::format(
          "{} is of specimen {} by its own words, and specimen {} has it: are two exchanged?",
          file.string(), named, id));
  };
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const io::SpecimenFiles& files = specimens[i];
    doubt(files.test, own[i].test_id, files.id);
    if (files.gauge) doubt(*files.gauge, own[i].logger_id, files.id);
  }
}

namespace {

// Checks compare specimens of one orientation, which is one angle.
void doubt_angles(LoadedStudy& loaded) {
  constexpr double hardly = 3.0 * calib::degree;
  std::map<double, std::string> ids;  // of each angle, the first
  for (const calib::Specimen& specimen : loaded.study.specimens)
    ids.try_emplace(specimen.orientation, specimen.id);
  std::vector<std::string> alike;
  // Compares neighbours, as the map is sorted by angle.
  for (auto next = ids.begin(), one = next; next != ids.end(); one = next++)
    if (one != next && next->first - one->first < hardly)
      alike.push_back(fmt::format("{:.4g} ({}) and {:.4g} ({})", one->first / calib::degree,
                                  one->second, next->first / calib::degree, next->second));
  if (!alike.empty())
    loaded.notes.push_back(fmt::format(
        "orientation_deg of {} count as different orientations, and what compares specimens of one "
        "has fewer: give them the angle that was meant, if it is one",
        fmt::join(alike, ", ")));
}

// Where sections do not tell the scatter, the model's is taken.
void doubt_scatter(LoadedStudy& loaded) {
  if (loaded.study.porosity.to_scatter != calib::ToScatter::window) return;
  for (const calib::Specimen& specimen : loaded.study.specimens) {
    if (specimen.sections.empty() ||
        std::isfinite(calib::pool_sections(specimen.sections).window_sd))
      continue;
    const bool scaled = std::ranges::any_of(
        specimen.sections, [](const auto& section) { return std::isfinite(section.pixel_size); });
    loaded.notes.push_back(
        fmt::format("the sections of specimen {} do not tell the scatter of its joints: {} "
                    "(model.joints.scatter) is taken; {}",
                    specimen.id, loaded.study.model.joints.scatter,
                    scaled ? "no window of a fibre lies in them" : "give its pixel_size_um"));
  }
}

// Specimens without sections beside others that have them: a study all of whose scatter is the
// model's says so itself.
void doubt_bare(LoadedStudy& loaded) {
  const calib::PorosityOptions& laws = loaded.study.porosity;
  std::vector<std::string> bare;
  for (const calib::Specimen& specimen : loaded.study.specimens)
    if (!calib::tells_scatter(specimen, laws)) bare.push_back(specimen.id);
  if (laws.to_scatter == calib::ToScatter::none || bare.empty() ||
      bare.size() == loaded.study.specimens.size())
    return;
  loaded.notes.push_back(
      fmt::format("nothing tells the scatter of {}, as sections do of others: {} "
                  "(model.joints.scatter) is taken",
                  fmt::join(bare, ", "), loaded.study.model.joints.scatter));
}

// Mostly of a pixel size that is wrong.
void doubt_pores(LoadedStudy& loaded) {
  if (loaded.study.porosity.to_scatter != calib::ToScatter::window) return;
  std::vector<std::string> of;
  for (const calib::Specimen& specimen : loaded.study.specimens) {
    if (specimen.sections.empty()) continue;
    const double missing = calib::missing_joints(calib::pool_sections(specimen.sections));
    if (missing > 0.0) of.push_back(fmt::format("{} ({:.2g} %)", specimen.id, 100.0 * missing));
  }
  if (!of.empty())
    loaded.notes.push_back(fmt::format(
        "pores are larger than a fibre and take joints away of {}: simulations have to follow "
        "their avalanches to the end and take far longer; is pixel_size_um right?",
        fmt::join(of, ", ")));
}

// Only what the tests do not tell is taken from the model.
void doubt_rate(bool given, LoadedStudy& loaded) {
  std::vector<std::string> silent;
  for (const calib::Specimen& specimen : loaded.study.specimens)
    if (!(specimen.test.strain_rate > 0.0)) silent.push_back(specimen.id);
  const sim::Scene& model = loaded.study.model;
  if (silent.empty() && given)
    loaded.notes.emplace_back(
        "model.loading.strain_rate_per_s changes nothing: every test has its own");
  if (!silent.empty() && !given && model.solver.regime != sim::Regime::quasi_static)
    loaded.notes.push_back(fmt::format(
        "no time tells the strain rate of specimen{} {}: {:g} 1/s is taken, and inertia with it "
        "(give model.loading.strain_rate_per_s)",
        silent.size() == 1 ? "" : "s", fmt::join(silent, ", "), model.loading.strain_rate));
}

// Least squares search all that no simulation has to be run for; what only a search without
// derivatives uses is idle then.
void doubt_search(LoadedStudy& loaded) {
  using calib::LocalSearch;
  const calib::CalibrateOptions& chosen = loaded.study.calibrate;
  if (chosen.local == LocalSearch::automatic && chosen.smooth) return;
  const std::size_t costly = calib::costly_unknowns(loaded.study);
  const auto idle = [&](const char* key) {
    loaded.notes.push_back(fmt::format(
        "calibrate.options.{} changes nothing: what is fitted needs no new simulations, and is "
        "found by least squares alone",
        key));
  };
  if (costly == 0 && chosen.local != LocalSearch::automatic) idle("local");
  if (costly == 0 && !chosen.smooth) idle("smooth");
  if (costly == 1 && chosen.local == LocalSearch::bobyqa)
    loaded.notes.emplace_back(
        "calibrate.options.local = \"bobyqa\" needs two parameters that need new simulations, and "
        "one is fitted: \"sbplx\" is taken");
}

}  // namespace

void doubt_model(bool rate_is_given, LoadedStudy& loaded) {
  for (const std::string& doubt : loaded.study.model.doubts())
    loaded.notes.push_back("model." + doubt);
  doubt_angles(loaded);
  doubt_scatter(loaded);
  doubt_bare(loaded);
  doubt_pores(loaded);
  doubt_rate(rate_is_given, loaded);
  doubt_search(loaded);
}

}  // namespace havers::cli
