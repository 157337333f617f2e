// Pieces that pages share. Templates have no logic: whether and how something is shown is decided
// in code.
#include "reports/pages/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/templates/templates.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

// Marks are in the order of calib::Outcome; a check that was not done has a dash.
std::string mark_of(const calib::Check& check) {
  constexpr std::array marks{"✓", "△", "✗"};
  return check.done ? marks.at(static_cast<std::size_t>(check.outcome)) : "–";
}

}  // namespace

bool available() {
  return true;
}

mstch::array fact_list(const Facts& facts) {
  return list_of(facts, [](const auto& fact) {
    return mstch::map{{"name", text(fact.first)}, {"value", text(fact.second)}};
  });
}

// If the node is false, the template leaves the section out with its heading.
mstch::node section(mstch::array items) {
  if (items.empty()) return mstch::node{false};
  return mstch::map{{"items", std::move(items)}};
}

mstch::node left_out_section(const std::vector<sim::LeftOut>& left_out) {
  Facts facts;
  for (const auto& [what, why] : left_out) facts.emplace_back(typeset(what), typeset(why));
  return section(fact_list(facts));
}

mstch::node correction_section(const std::vector<calib::Correction>& corrections) {
  Facts facts;
  for (const auto& [what, detail] : corrections) facts.emplace_back(what, typeset(detail));
  return section(fact_list(facts));
}

mstch::node text_section(const std::vector<std::string>& sentences) {
  return section(list_of(sentences, [](const auto& one) { return text(typeset(one)); }));
}

mstch::node check_section(const std::vector<calib::Check>& checks) {
  return section(list_of(checks, [](const calib::Check& check) {
    return mstch::map{{"outcome", text(check.done ? to_string(check.outcome) : "not done")},
                      {"mark", text(mark_of(check))},
                      {"check", text(check.check)},
                      {"text", text(typeset(check.text))}};
  }));
}

// A single one is not counted: "The test can be used".
std::string how_many_can(const std::string& verb, const std::string& noun, std::size_t all,
                         const std::vector<std::string>& cannot) {
  if (all == 1) return fmt::format("The {} can{} {}", noun, cannot.empty() ? "" : "not", verb);
  const std::string counted = count(static_cast<long>(all), noun);
  if (cannot.empty()) return fmt::format("{} of {} can {}", all, counted, verb);
  return fmt::format("{} of {} cannot {} ({})", cannot.size(), counted, verb,
                     fmt::join(cannot, ", "));
}

std::string fit_sentence(const calib::CalibrationResult& result) {
  if (!result.trusted())
    return fmt::format("The fit cannot be trusted: {}.", why_not_trusted(result));
  const std::size_t warned = checks_with(result, calib::Outcome::warn).size();
  return warned == 0
             ? "The fit can be trusted."
             : fmt::format("The fit can be trusted, with {}.", count(warned, "reservation"));
}

std::string status_sentence(const calib::CalibrationResult& result) {
  const auto used =
      std::ranges::count(result.specimens, calib::Use::fit, &calib::SpecimenResult::use);
  const auto all = static_cast<long>(result.specimens.size());
  return fmt::format("How the search ended: {}. {} fitted, {} kept for validation.",
                     explain(result.status), count(used, "specimen"), all - used);
}

std::string search_sentence(const FitReport& report) {
  const calib::CalibrationResult& result = report.result;
  return fmt::format(
      "{} after {} ({} run, {} taken from the store, {} asked for again; {} "
      "failed) in {} wall time.",
      std::isfinite(result.cost) ? fmt::format("Cost ½ Σ residual² = {}", number(result.cost))
                                 : "No answer",
      count(result.evaluations, "simulation"), result.simulated,
      result.distinct_simulations - result.simulated,
      result.evaluations - result.distinct_simulations, result.failed_simulations,
      duration(report.provenance.wall_seconds));
}

std::string section_caption(const calib::SectionPorosity& section) {
  return fmt::format(
      "{}: porosity {}\u00a0%, {} on {}\u00a0mm² of bone, standard deviation {}\u00a0% in windows "
      "of one fibre; {}, threshold at a depth of {} (0 bone, 1 pore), pixel {}",
      base_name(section.file),
      plus_minus(section.porosity / in::percent, section.porosity_standard_error / in::percent),
      count(section.pore_count, "pore"), number(section.bone_area / in::mm2, 3),
      number(section.window_sd / in::percent, 3), section.method, number(section.threshold, 3),
      quantity(section.pixel_size / in::um, "µm", 3));
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "unrecorded";
  if (seconds < 60.0) return quantity(seconds, "s", 3);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}\u00a0min {}\u00a0s", whole / 60, whole % 60);
  return fmt::format("{}\u00a0h {}\u00a0min", whole / 3600, whole % 3600 / 60);
}

std::string degrees(double radians) {
  return fmt::format("{:.4g}°", radians / calib::degree);
}

std::string base_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

void Footer::add(const calib::Provenance& provenance, const std::string& whose) {
  const auto add_fact = [&](const char* name, const std::string& value) {
    facts.emplace_back(whose + name, value);
  };
  // Results that were read back from files may lack some of these.
  if (!provenance.command.empty()) add_fact("Command", provenance.command);
  if (!provenance.havers.empty())
    add_fact("Program", fmt::format("havers {}, {}", provenance.havers, provenance.compiler));
  if (std::isfinite(provenance.wall_seconds))
    add_fact("Wall time", fmt::format("{:.3g} s", provenance.wall_seconds));
  if (std::isfinite(provenance.cpu_seconds))
    add_fact("CPU time", fmt::format("{:.3g} s", provenance.cpu_seconds));
  for (const auto& [file, digest] : provenance.inputs) digests.emplace_back(whose + file, digest);
}

std::string render_page(const std::string& title, const std::string& name, mstch::map content,
                        const Footer& footer) {
  // The body is rendered first, then the frame around it.
  const std::string body = mstch::render(templates().at(name), content, templates());
  return mstch::render(
      templates().at("page"),
      mstch::map{{"title", text(title)},
                 {"body", text(body)},
                 {"has_provenance", !footer.facts.empty()},
                 {"provenance", fact_list(footer.facts)},
                 {"has_digests", !footer.digests.empty()},
                 {"digest_count", text(count(footer.digests.size(), "input file"))},
                 {"digests", fact_list(footer.digests)}},
      templates());
}

std::string render_page(const std::string& title, const std::string& name, mstch::map content,
                        const calib::Provenance& provenance) {
  Footer footer;
  footer.add(provenance);
  return render_page(title, name, std::move(content), footer);
}

}  // namespace havers::reports
