// Fits side by side. Their outcomes can be compared only if it is known in what the fits differ: of
// each fit the page says how it differs from the first.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

// The parameters of all fits in the order in which they appear.
std::vector<std::string> names_of(const std::vector<FitReport>& fits) {
  std::vector<std::string> names;
  for (const FitReport& fit : fits)
    for (const auto& parameter : fit.result.parameters)
      if (std::ranges::find(names, parameter.name) == names.end()) names.push_back(parameter.name);
  return names;
}

// A row for each fit that has it; the parameter is named in the first.
mstch::array parameter_rows(const std::vector<FitReport>& fits) {
  mstch::array rows;
  for (const std::string& name : names_of(fits)) {
    bool first = true;
    for (const FitReport& fit : fits) {
      const auto& all = fit.result.parameters;
      const auto p = std::ranges::find(all, name, &calib::CalibratedParameter::name);
      if (p == all.end()) continue;
      const bool held = !p->left_out_because.empty();
      rows.emplace_back(mstch::map{
          {"symbol", text(first ? axis_label(name) : "")},
          {"key", text(first ? name : "")},
          {"fit", text(fit.study.name)},
          {"estimate", text(held ? number(p->value) : plus_minus(p->value, p->standard_error))},
          {"interval", text(held ? "held" : interval(p->interval_95[0], p->interval_95[1]))}});
      first = false;
    }
  }
  return rows;
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Of a command as a shell takes it.
std::vector<std::string> shell_words(const std::string& command) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\'')
      quoted = !quoted;
    else if (command[i] == ' ' && !quoted)
      words.emplace_back();
    else if (command[i] == '\\' && !quoted && i + 1 < command.size())
      words.back() += command[++i];
    else
      words.back() += command[i];
  }
  return words;
}

// What was given on the command line beside the study: "--set model.x=1", "--seed 2".
std::string settings_of(const FitReport& fit) {
  std::vector<std::string> settings;
  const std::vector<std::string> words = shell_words(fit.provenance.command);
  for (std::size_t i = 0; i < words.size(); ++i)
    for (const std::string option : {"--set", "--seed"})
      if (words[i] == option && i + 1 < words.size())
        settings.push_back(fmt::format("{} {}", option, words[++i]));
      else if (words[i].starts_with(option + "="))
        settings.push_back(fmt::format("{} {}", option, words[i].substr(option.size() + 1)));
  return settings.empty() ? "none" : joined(settings);
}

std::string parameters_of(const FitReport& fit) {
  std::vector<std::string> symbols;
  for (const auto& parameter : fit.result.parameters) symbols.push_back(symbol_of(parameter.name));
  return joined(symbols);
}

std::string specimens_of(const FitReport& fit) {
  std::vector<std::string> ids;
  for (const auto& specimen : fit.result.specimens)
    ids.push_back(specimen.id + (specimen.use == calib::Use::fit ? "" : " (validation)"));
  return joined(ids);
}

// Digests of the files that a fit read, by their names, which those of several folders may share.
std::map<std::string, std::set<std::string>> digests_of(const FitReport& fit) {
  std::map<std::string, std::set<std::string>> files;
  for (const auto& [name, digest] : fit.provenance.inputs) files[base_name(name)].insert(digest);
  return files;
}

// "contents of A1.csv", "without A2.csv", "with A3.csv".
std::vector<std::string> files_unlike(const FitReport& fit, const FitReport& first) {
  const auto these = digests_of(fit), those = digests_of(first);
  std::vector<std::string> changed, missing, besides, parts;
  for (const auto& [name, digests] : those) {
    const auto found = these.find(name);
    if (found == these.end())
      missing.push_back(name);
    else if (found->second != digests)
      changed.push_back(name);
  }
  for (const auto& [name, digests] : these)
    if (!those.contains(name)) besides.push_back(name);
  if (!changed.empty()) parts.push_back("contents of " + joined(changed));
  if (!missing.empty()) parts.push_back("without " + joined(missing));
  if (!besides.empty()) parts.push_back("with " + joined(besides));
  return parts;
}

std::string program_of(const FitReport& fit) {
  return fmt::format("havers {}, {}", fit.provenance.havers, fit.provenance.compiler);
}

// In what a fit differs from the first of the page, but for its outcome.
std::string differs_in(const FitReport& fit, const FitReport& first) {
  std::vector<std::string> parts;
  // Texts are compared as they are shown, so that a reader sees every difference that is stated.
  const auto compare = [&](const char* what, std::string (*of)(const FitReport&)) {
    if (of(fit) != of(first)) parts.push_back(fmt::format("{}: {}", what, of(fit)));
  };
  compare("parameters", parameters_of);
  compare("specimens", specimens_of);
  compare("settings", settings_of);
  for (std::string& files : files_unlike(fit, first)) parts.push_back(std::move(files));
  compare("program", program_of);
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, "; "));
}

mstch::map fit_content(const FitReport& fit, const FitReport& first) {
  const calib::CalibrationResult& result = fit.result;
  return {{"name", text(fit.study.name)},
          {"differs", text(&fit == &first ? "–" : differs_in(fit, first))},
          {"outcome", text(result.trusted() ? "pass" : "fail")},
          {"grade", grade(result.trusted())},
          {"sentence", text(fit_sentence(result))},
          {"detail", text(search_sentence(fit))},
          {"cost", text(number(result.cost))},
          {"specimens", text(std::to_string(result.specimens.size()))},
          {"evaluations", text(std::to_string(result.evaluations))},
          {"wall", text(duration(fit.provenance.wall_seconds))},
          {"checks", check_section(result.verdict)}};
}

// Which fits can be trusted, and how many with reservations.
mstch::map verdict_of_fits(const std::vector<FitReport>& fits) {
  std::vector<std::string> cannot;
  long reserved = 0;
  for (const FitReport& fit : fits)
    if (!fit.result.trusted())
      cannot.push_back(fit.study.name);
    else if (!checks_with(fit.result, calib::Outcome::warn).empty())
      ++reserved;
  const std::string reserve = reserved == 0 ? "" : fmt::format(", {} with reservations", reserved);
  return {
      {"grade", grade(cannot.empty(), reserved == 0)},
      {"sentence", text(how_many_can("be trusted", "fit", fits.size(), cannot) + reserve + ".")}};
}

}  // namespace

std::string comparison_page(const std::vector<FitReport>& reports) {
  mstch::array fits;
  Footer footer;
  for (const FitReport& fit : reports) {
    fits.emplace_back(fit_content(fit, reports.front()));
    // With the name of the study, as files of different fits may have the same name.
    footer.add(fit.provenance, fit.study.name + ": ");
  }
  mstch::map content = verdict_of_fits(reports);
  content["fits"] = fits;
  content["intervals"] = text(draw(intervals_figure(reports, "intervals")));
  content["parameters"] = parameter_rows(reports);
  content["held"] = std::ranges::any_of(reports, [](const FitReport& fit) {
    return std::ranges::any_of(fit.result.parameters, [](const calib::CalibratedParameter& p) {
      return !p.left_out_because.empty();
    });
  });
  return render_page(fmt::format("havers report: {} side by side", count(reports.size(), "fit")),
                     "comparison", content, footer);
}

}  // namespace havers::reports
