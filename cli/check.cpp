// havers check: every problem of a study, a scene or a sweep, nothing run.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "calib/count.hpp"
#include "cli/command.hpp"
#include "cli/load_study.hpp"
#include "io/config/file_kind.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"
#include "io/sweep/read_sweep.hpp"
#include "sim/dynamics/step_control.hpp"

namespace havers::cli {
namespace {

constexpr const char* check_examples =
    "  havers check data_samples/bone_bars/study.toml\n"
    "  havers check data_samples/scenes/impact.toml --json\n"
    "  havers check data_samples/paper/R5_rates.toml\n";

struct Findings {
  std::optional<io::FileKind> kind;  // none: the file cannot be read
  std::vector<io::Problem> problems;
  std::vector<std::string> warnings;
};

// Reads the input as its command would, and keeps the problems that the command would report.
Findings look_at(const std::filesystem::path& file, const io::Overrides& overrides) {
  Findings findings;
  try {
    findings.kind = io::kind_of_file(file, overrides);
    switch (*findings.kind) {
      case io::FileKind::study:
        // If load_study throws, the pointer has given the notes so far.
        findings.warnings = load_study(file, overrides, &findings.warnings).all_notes();
        break;
      case io::FileKind::sweep:
        findings.warnings = io::read_sweep(file, overrides).warnings;
        break;
      case io::FileKind::scene:
        io::SceneFile read = io::read_scene(file, overrides, io::Snapshots::written);
        findings.warnings = std::move(read.warnings);
        if (const std::string doubt = sim::doubt_about_steps(read.scene); !doubt.empty())
          findings.warnings.push_back(doubt);
    }
  } catch (const io::InputError& error) {
    findings.problems = error.problems();
  }
  return findings;
}

void print_json(const std::filesystem::path& file, const Findings& findings) {
  const nlohmann::json all{
      {"file", file.string()},
      {"kind", findings.kind ? nlohmann::json(io::name_of(*findings.kind)) : nlohmann::json()},
      {"problems", json_of(findings.problems)},
      {"warnings", findings.warnings}};
  fmt::print("{}", io::json_text(all));
}

int run_check(const std::filesystem::path& file, const CommonOptions& common) {
  note_idle_seed(common, "havers check runs nothing");
  const Findings findings = look_at(file, common.set);
  // The JSON holds the problems: if they were thrown, `main` would print a second JSON.
  if (common.json) {
    print_json(file, findings);
    return findings.problems.empty() ? done : bad_input;
  }
  for (const std::string& warning : findings.warnings) fmt::print("note: {}\n", warning);
  if (!findings.problems.empty()) throw io::InputError(findings.problems);
  const std::size_t notes = findings.warnings.size();
  fmt::print("no problems in this {}{}\n", io::name_of(*findings.kind),
             notes == 0 ? "" : ", " + calib::count(notes, "note"));
  return done;
}

}  // namespace

Command check_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser =
      add_command(app, common, "check", "every problem of a study, scene or sweep, nothing run",
                  check_examples);
  say_seed_is_idle(*parser);
  const auto file = std::make_shared<std::filesystem::path>();
  parser->add_option("INPUT", *file, "study, scene or sweep file (TOML)")->required();
  return {parser, [file, &common] { return run_check(*file, common); }};
}

}  // namespace havers::cli
