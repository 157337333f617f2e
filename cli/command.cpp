// What all commands share: the common options, which mean the same everywhere, and how a run ends.
#include "cli/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/number_check.hpp"
#include "cli/output_folder.hpp"
#include "cli/version.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"
#include "reports/pages.hpp"

namespace havers::cli {
namespace {

constexpr int most_threads = 1024;  // more than a machine has, fewer than it refuses

}  // namespace

CLI::App* add_command(CLI::App& app, CommonOptions& common, const std::string& name,
                      const std::string& sentence, const std::string& examples) {
  CLI::App* command = app.add_subcommand(name, sentence);
  command->group("Commands");
  command->footer("Examples:\n" + examples +
                  "\nExit codes: 0 done and to be trusted; 1 done, but the answer is no; "
                  "2 usage, input, or a part not built in.");
  command->add_flag("--json", common.json, "one JSON object on stdout instead of the summary");
  command->add_flag("-q,--quiet", common.quiet, "no notes and no progress");
  command->add_flag("-v,--verbose", common.verbose, "what a run or fit left out, too");
  command->add_option("--threads", common.threads, "threads; never changes a number (default: all)")
      ->type_name("N")
      ->check(count(most_threads));
  command->add_option("--seed", common.seed, "instead of the input's seed")
      ->type_name("N")
      ->check(seed_number());
  command
      ->add_option("--set", common.set,
                   "instead of the input's: joints.scatter=0.4 of a scene, "
                   "model.joints.scatter=0.4 of a study; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // Else --set would also take the words behind its value.
  command->add_flag("--force", common.force, "write into a folder that already holds a run");
  command->set_version_flag("--version", version_text, "version and what is built in");
  return command;
}

void say_seed_is_idle(CLI::App& command) {
  command.get_option("--seed")->description("changes nothing here");
}

void say_settings_are_refused(CLI::App& command) {
  command.get_option("--set")->description("sets nothing here, and is refused");
  say_seed_is_idle(command);
}

CLI::Option* add_output(CLI::App& command, std::filesystem::path& folder, const std::string& help) {
  const auto complaint = [](const std::string& text) -> std::string {
    return text.empty() ? "is empty, must name a folder" : "";
  };
  return command.add_option("-o,--output", folder, help)
      ->type_name("DIR")
      ->check(CLI::Validator(complaint, ""));
}

void note_idle_seed(const CommonOptions& common, const std::string& what) {
  if (common.seed) note(common, "note: --seed changes nothing: " + what);
}

// A key that a command does not have is refused like any that is not known.
void refuse_settings(const CommonOptions& common, const std::string& what) {
  note_idle_seed(common, what);
  if (!common.set.empty())
    throw io::InputError("--set " + common.set.front(), "sets nothing: " + what,
                         "leave it out, -h shows the options that there are");
}

void say(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

ExitCode refuse(const io::InputError& error) {
  for (const io::Problem& problem : error.problems()) say("havers: " + io::to_string(problem));
  return bad_input;
}

// On stderr, as stdout is for the result.
void note(const CommonOptions& common, const std::string& sentence) {
  if (!common.quiet) say(sentence);
}

io::SceneFile load_scene(const std::filesystem::path& file, const CommonOptions& common,
                         io::Snapshots snapshots) {
  io::SceneFile scene = io::read_scene(file, common.set, snapshots);
  if (common.seed) scene.scene.joints.seed = *common.seed;
  for (const std::string& warning : scene.warnings) note(common, "note: " + warning);
  if (!scene.scene.joints.thresholds.empty())
    note_idle_seed(common, "thresholds_file gives those of every joint");
  return scene;
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

// With one file its keys are at the top as well as in the list, so that scripts need no index.
nlohmann::json json_of_files(const std::string& name, nlohmann::json entries, std::size_t files) {
  nlohmann::json json =
      files == 1 && entries.size() == 1 ? entries.front() : nlohmann::json::object();
  json[name] = std::move(entries);
  return json;
}

std::string page_or(const std::string& file) {
  return reports::available() ? "report.html" : file;
}

void answer(const CommonOptions& common, OutputFolder* output, const nlohmann::json& json,
            const std::string& file, const std::function<void()>& print) {
  // Files are moved to their place before anything is printed about them.
  if (output != nullptr) output->publish();
  if (common.json) {
    fmt::print("{}", io::json_text(json));
    return;
  }
  print();
  if (output != nullptr) fmt::print("{}\n", (output->folder() / file).string());
}

nlohmann::json json_of(const std::vector<io::Problem>& problems) {
  nlohmann::json all = nlohmann::json::array();
  for (const io::Problem& problem : problems)
    all.push_back({{"where", problem.where}, {"what", problem.what}, {"hint", problem.hint}});
  return all;
}

ExitCode without_result(const CommonOptions& common, const std::string& status,
                        const std::string& why) {
  say(why);
  if (common.json)
    fmt::print("{}", io::json_text({{"status", status}, {"status_text", why}, {"trusted", false}}));
  return answer_is_no;
}

}  // namespace havers::cli
