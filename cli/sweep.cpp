// havers sweep: the model over many scenes, and what they say together.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "calib/count.hpp"
#include "calib/decimals.hpp"
#include "calib/sweep/measure_words.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/kept_run.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/input_error.hpp"
#include "io/sweep/read_sweep.hpp"
#include "io/sweep/sweep_files.hpp"
#include "io/sweep/sweep_keys.hpp"
#include "reports/sweep/sweep_page.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* sweep_examples =
    "  havers sweep data_samples/paper/R4_along.toml -o runs/along\n"
    "  havers sweep data_samples/paper/R4_along.toml -o runs/along   # after Ctrl-C: goes on\n"
    "  havers sweep data_samples/paper/R*.toml -o runs/paper --title 'What the paper found'\n";

struct SweepArguments {
  std::vector<fs::path> files;
  fs::path folder;
  std::string title = "havers sweep";
};

// A sweep with its results; `stem` is the name of its folder.
struct Done {
  std::string stem;
  std::vector<fs::path> inputs;
  calib::Sweep sweep;
  calib::SweepResult result;
};

// All sweeps are read before one of them runs; the problems of all are thrown at once.
std::vector<Done> read_all(const SweepArguments& arguments, const CommonOptions& common) {
  std::vector<Done> all;
  std::vector<io::Problem> problems;
  // The folder of each sweep has the name of its file. These two names are already in use.
  std::set<std::string> stems{"result.json", "report.html"};
  for (const fs::path& file : arguments.files) {
    if (!stems.insert(file.stem().string()).second)
      problems.push_back({file.string(), "has the file name of another sweep or of a result",
                          "rename one: its results are in a folder of that name"});
    if (file.stem().string().find('\n') != std::string::npos)
      problems.push_back({file.string(), "has a line break in its name",
                          "rename it: its results are in a folder of that name"});
    try {
      io::SweepFile read = io::read_sweep(file, common.set, common.seed);
      for (const std::string& warning : read.warnings)
        note(common, fmt::format("note: {}: {}", file.string(), warning));
      all.push_back({file.stem().string(), std::move(read.inputs), std::move(read.sweep), {}});
    } catch (const io::InputError& error) {
      io::collect(problems, error.problems());
    }
  }
  if (!problems.empty()) throw io::InputError(std::move(problems));
  return all;
}

// False when the user stopped it.
bool run_all(std::vector<Done>& all, calib::EvaluationStore& store, const CommonOptions& common) {
  ProgressLine line(common);
  for (Done& one : all) {
    const auto watch = [&](std::size_t done, std::size_t runs) {
      if (line.due()) line.show(fmt::format("{}: {} of {} runs", one.stem, done, runs));
      return !interrupted();
    };
    one.result = calib::run_sweep(one.sweep, &store, common.threads, watch, interrupted);
    if (one.result.cancelled) return false;
  }
  return true;
}

std::vector<fs::path> inputs_of(const std::vector<Done>& all) {
  std::vector<fs::path> inputs;
  for (const Done& one : all) inputs.insert(inputs.end(), one.inputs.begin(), one.inputs.end());
  return inputs;
}

calib::SweepTotals totals_of(const std::vector<Done>& all) {
  calib::SweepTotals totals;
  for (const Done& one : all) totals.add(one.result);
  return totals;
}

nlohmann::json json_of_all(const std::vector<Done>& all, const calib::Provenance& provenance) {
  nlohmann::json sweeps = nlohmann::json::array();
  for (const Done& one : all) sweeps.push_back(io::sweep_json(one.sweep, one.result));
  const calib::SweepTotals totals = totals_of(all);
  return {{"status", "finished"},
          {"trusted", totals.trusted},
          {"evaluations", totals.runs},
          {"simulated", totals.simulated},
          {"failed_simulations", totals.failed},
          {"unbroken_simulations", totals.unbroken},
          {"simulations_with_reservation", totals.reserved},
          {"wall_s", provenance.wall_seconds},
          {"sweeps", sweeps},
          {"provenance", io::provenance_object(provenance)}};
}

// Returns what is in result.json.
nlohmann::json write_all(const OutputFolder& output, const SweepArguments& arguments,
                         const std::vector<Done>& all, const calib::Provenance& provenance) {
  std::vector<reports::SweepReport> parts;
  for (const Done& one : all) {
    output.write(fs::path(one.stem) / "runs.csv", io::runs_csv(one.sweep, one.result));
    output.write(fs::path(one.stem) / "summary.csv", io::summary_csv(one.sweep, one.result));
    if (!one.result.laws.empty())
      output.write(fs::path(one.stem) / "laws.json", io::json_text(io::laws_json(one.result)));
    parts.push_back({one.stem, one.sweep, one.result});
  }
  if (reports::available())
    output.write("report.html", reports::sweep_page(arguments.title, parts, provenance));
  nlohmann::json json = json_of_all(all, provenance);
  output.write("result.json", io::json_text(json));
  return json;
}

// "strength 12.3 % (11.9 to 12.7)", to two digits of the interval's width or one more; a dash where
// nothing could be compared.
std::string found(const calib::Finding& finding) {
  if (!std::isfinite(finding.value)) return fmt::format("{} -", io::word(finding.response));
  const auto [name, unit, scale] = judges_means(finding.test) ? calib::words_of(finding.response)
                                                              : calib::MeasureWords{"", "%", 0.01};
  const double width = (finding.high - finding.low) / scale;
  const bool known = std::isfinite(width) && width > 0.0;
  const int decimals =
      (known ? calib::decimals_for(width) : 3) + calib::extra_digits(finding, scale);
  const auto shown = [&, scale = scale](double number) {
    const std::string text = fmt::format("{:.{}f}", number / scale, decimals);
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    return zero ? fmt::format("{:.{}f}", 0.0, decimals) : text;  // without a minus
  };
  return fmt::format("{} {}{}{} ({})", io::word(finding.response), shown(finding.value),
                     unit.empty() ? "" : " ", unit,
                     std::isfinite(width)
                         ? fmt::format("{} to {}", shown(finding.low), shown(finding.high))
                         : "interval not known");
}

// "ratio = 0.333: ", where a finding has a place.
std::string place_of(const calib::Finding& finding) {
  return finding.per.empty()
             ? ""
             : fmt::format("{} = {}: ", finding.per.substr(finding.per.rfind('.') + 1), finding.at);
}

void print_summary(const std::vector<Done>& all, double wall_seconds) {
  const auto [trusted, runs, failed, unbroken, reserved, simulated] = totals_of(all);
  fmt::print("{}: {}, {} failed, {} did not break; {} of them simulated now, in {:.3g} s\n",
             trusted ? "to be trusted" : "NOT to be trusted: too many runs failed or did not break",
             calib::count(runs, "run"), failed, unbroken, simulated, wall_seconds);
  for (const Done& one : all) {
    calib::SweepTotals totals;
    totals.add(one.result);
    // For each sweep on its own, as their reservations differ.
    if (totals.reserved > 0)
      fmt::print("{} of {} with a reservation, most often so: {}\n",
                 calib::count(totals.reserved, "run"), one.stem, one.result.most_reserved_because);
  }
  for (const Done& one : all)
    for (const calib::Finding& finding : one.result.findings)
      fmt::print("{:<6}{:<12}{}{}; {}  {}\n", finding.id, calib::to_string(finding.outcome),
                 place_of(finding), found(finding), calib::count(finding.runs, "run"),
                 finding.claim);
}

int run_sweeps(const SweepArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  std::vector<Done> all = read_all(arguments, common);
  // Now, as files may be changed during the runs.
  Digests inputs = digests_of(inputs_of(all));
  catch_interrupts();
  KeptRun run("sweep", arguments.files, inputs_of(all), arguments.folder, common);
  if (!run_all(all, run.store(), common)) {
    // Runs of sweeps with patterns are not stored, as a store does not hold patterns of joints.
    const bool patterns =
        std::ranges::any_of(all, [](const Done& one) { return one.sweep.patterns; });
    return without_result(
        common, "cancelled",
        fmt::format("stopped by you; the runs so far are kept in {}{}: the same command goes on "
                    "from there",
                    run.output().folder().string(),
                    patterns ? ", but those of sweeps with patterns, which begin anew" : ""));
  }
  const calib::Provenance provenance = provenance_of(common, std::move(inputs), watch);
  const nlohmann::json json = write_all(run.output(), arguments, all, provenance);
  answer(common, &run.output(), json, page_or("result.json"),
         [&] { print_summary(all, provenance.wall_seconds); });
  return totals_of(all).trusted ? done : answer_is_no;
}

}  // namespace

Command sweep_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "sweep",
                                 "the model over a grid or sample of parameters; laws fitted to it",
                                 sweep_examples);
  const auto arguments = std::make_shared<SweepArguments>();
  parser->add_option("SWEEP", arguments->files, "sweep files (TOML)")->required();
  add_output(*parser, arguments->folder, "folder for the results")->required();
  parser->add_option("--title", arguments->title, "of the page")->type_name("TITLE");
  return {parser, [arguments, &common] { return run_sweeps(*arguments, common); }};
}

}  // namespace havers::cli
