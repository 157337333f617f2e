// What the commands of havers have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/config/read_scene.hpp"
#include "io/input_error.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace havers::cli {

/// The exit codes every script may rely on.
enum ExitCode {
  done = 0,          ///< Done, and to be trusted.
  answer_is_no = 1,  ///< Done, but not converged, rejected or stopped.
  bad_input = 2,     ///< Usage, input, or a part that is not built in.
};

/// Options that every command takes.
struct CommonOptions {
  bool json = false;     ///< One JSON object on stdout instead of the summary.
  bool quiet = false;    ///< No notes and no progress on stderr.
  bool verbose = false;  ///< What was left out, on stdout.
  bool force = false;    ///< Write into a folder that holds a run.
  int threads = 0;       ///< 0: as many as the machine has. Never changes a number.
  std::optional<std::uint64_t> seed;
  io::Overrides set;
  std::string command_line;  ///< As typed, for the provenance.
};

/// A command: its parser, and what it does when chosen; `run` returns the exit code.
struct Command {
  CLI::App* parser = nullptr;
  std::function<int()> run;
};

/// What is wrong with an input, for --json.
nlohmann::json json_of(const std::vector<io::Problem>& problems);

/// The commands of cli/README.md. Each adds its parser to `app` and keeps a reference to `common`,
/// which has to live longer than the command.
Command fit_command(CLI::App& app, CommonOptions& common);
Command simulate_command(CLI::App& app, CommonOptions& common);
Command import_command(CLI::App& app, CommonOptions& common);
Command porosity_command(CLI::App& app, CommonOptions& common);
Command check_command(CLI::App& app, CommonOptions& common);
Command synthesize_command(CLI::App& app, CommonOptions& common);
Command report_command(CLI::App& app, CommonOptions& common);
Command sweep_command(CLI::App& app, CommonOptions& common);
Command bench_command(CLI::App& app, CommonOptions& common);

/// Adds a sub-command with the common options, a sentence of what it does, and examples under -h.
CLI::App* add_command(CLI::App& app, CommonOptions& common, const std::string& name,
                      const std::string& sentence, const std::string& examples);

/// Says in the -h of a command that draws nothing what --seed does there.
void say_seed_is_idle(CLI::App& command);

/// The same of --set and --seed where a command has nothing to set.
void say_settings_are_refused(CLI::App& command);

/// Adds -o,--output DIR, which names a folder.
CLI::Option* add_output(CLI::App& command, std::filesystem::path& folder, const std::string& help);

/// Notes where --seed is given to a command that draws nothing.
void note_idle_seed(const CommonOptions& common, const std::string& what);

/// The same, and @throws io::InputError where --set is given to a command that has nothing to set.
void refuse_settings(const CommonOptions& common, const std::string& what);

/// A line on stderr. Where that cannot be written it is lost, which ends no run.
void say(const std::string& line);

/// What is wrong with an input, a line each on stderr, none of them twice. Returns the exit code.
ExitCode refuse(const io::InputError& error);

/// A note for the user on stderr; silent with -q.
void note(const CommonOptions& common, const std::string& sentence);

/// A scene with --set and --seed; notes which keys and options change nothing. @throws
/// io::InputError as io::read_scene.
io::SceneFile load_scene(const std::filesystem::path& file, const CommonOptions& common,
                         io::Snapshots snapshots = io::Snapshots::ignored);

/// A number of a table on stdout; a dash for what is not known.
std::string cell(double value, int decimals);

/// The object of --json of a command that takes several files: `entries` as `name`, and where one
/// file was asked for and has one entry, its keys beside them.
nlohmann::json json_of_files(const std::string& name, nlohmann::json entries, std::size_t files);

class OutputFolder;

/// The page's name, or of `file` where this build makes no pages.
std::string page_or(const std::string& file);

/// The end of a run: its files at their place, where it has a folder; then on stdout `json` with
/// --json, else what `print` prints and the path of `file`.
void answer(const CommonOptions& common, OutputFolder* output, const nlohmann::json& json,
            const std::string& file, const std::function<void()>& print);

/// What a run prints that ends without a result: why, on stderr; with --json the status too, on
/// stdout. Returns the exit code.
ExitCode without_result(const CommonOptions& common, const std::string& status,
                        const std::string& why);

}  // namespace havers::cli
