// havers: the one program. Parses, calls, prints.
#include <fcntl.h>
#include <fmt/core.h>
#include <gsl/gsl_errno.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/version.hpp"
#include "io/config/nearest.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"
#include "sim/memory.hpp"

namespace havers::cli {
namespace {

constexpr const char* main_examples =
    "Examples:\n"
    "  havers fit data_samples/bone_bars/study.toml -o runs/first\n"
    "  havers simulate data_samples/scenes/impact.toml -o runs/impact "
    "--set loading.strain_rate_per_s=500\n"
    "  havers import data_samples/bone_bars/A1.csv --json\n"
    "havers COMMAND -h says more about a command.";

// As a shell takes it: what is not plain in single quotes, these themselves behind a backslash.
std::string typed(int argc, char** argv) {
  std::string text = "havers";
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    const bool plain =
        !word.empty() && word.find_first_of(" \t\n\\'\"`$&|;<>()*?[]{}~#!") == std::string::npos;
    for (auto at = word.find('\''); at != std::string::npos; at = word.find('\'', at + 4))
      word.replace(at, 1, "'\\''");
    text += plain ? " " + word : " '" + word + "'";
  }
  return text;
}

// The first word or option that nothing knows, with what may be meant; empty where all are known.
std::string unknown_word(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  const CLI::App& used = commands.empty() ? app : *commands.front();
  const std::vector<std::string> rest = used.remaining();
  if (rest.empty()) return "";
  const auto is_option = [](const std::string& word) { return word.starts_with("-"); };
  std::set<std::string, std::less<>> known;
  if (commands.empty() && !is_option(rest.front())) {  // its options are those of no command yet
    for (const CLI::App* command : app.get_subcommands({})) known.insert(command->get_name());
    return fmt::format("{} is no command, {}", rest.front(),
                       io::nearest_or_all(rest.front(), known));
  }
  const auto option = std::ranges::find_if(rest, is_option);
  if (option == rest.end()) return "";
  for (const CLI::Option* one : used.get_options())
    for (const std::string& name : one->get_lnames()) known.insert("--" + name);
  const std::string hint = io::did_you_mean(option->substr(0, option->find('=')), known);
  return fmt::format("{} is no option of {}{}", *option, used.get_name(),
                     hint.empty() ? "" : ", " + hint);
}

// Whether it can be printed is asked at the end.
void print_refusal(const std::vector<io::Problem>& problems) {
  const std::string text =
      io::json_text({{"status", "refused"}, {"trusted", false}, {"problems", json_of(problems)}});
  std::fputs(text.c_str(), stdout);
}

// CLI11 answers -h and --version through exceptions too; those are successes.
int answer(const CLI::App& app, const CLI::ParseError& error, bool json) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const std::string unknown = unknown_word(app);
  const std::string what = unknown.empty() ? error.what() : unknown;
  constexpr const char* hint = "havers -h and havers COMMAND -h show how it is used";
  if (json) print_refusal({{"command line", what, hint}});
  // Without any command the user is shown which there are.
  if (unknown.empty() && app.get_subcommands().empty())
    std::fputs(app.help().c_str(), stderr);
  else
    say(fmt::format("havers: {} ({})", what, hint));
  return bad_input;
}

// Every exception becomes a message on stderr and an exit code. Problems of an input are one line
// each; with --json they are also printed as JSON.
int run(const Command& command, const CommonOptions& common) {
  // The limit holds as long as this object lives: while the command runs.
  std::optional<tbb::global_control> limit;
  if (common.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(common.threads));
  std::vector<io::Problem> problems;
  try {
    return command.run();
  } catch (const io::InputError& error) {
    problems = error.problems();
  } catch (const std::filesystem::filesystem_error& error) {
    problems.push_back({error.path1().string(), error.code().message(), ""});
  } catch (const std::bad_alloc&) {
    problems.push_back({"this machine", "its memory does not suffice", ""});
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return bad_input;  // a full disk: no answer either way
    problems.push_back({command.parser->get_name(), error.what(), ""});
  }
  if (common.json) print_refusal(problems);
  return refuse(io::InputError(std::move(problems)));
}

// The words of the help, for all commands; to be called before they are added.
void word_help(CLI::App& app) {
  app.set_help_flag("-h,--help", "this help");
  const auto formatter = app.get_formatter();
  for (const auto& [cli11, ours] : {std::pair("SUBCOMMAND", "COMMAND"),
                                    {"REQUIRED", "(required)"},
                                    {"FLOAT", "NUMBER"},
                                    {"Positionals", "Input"},
                                    {"TEXT", ""}})
    formatter->label(cli11, ours);
}

int program(int argc, char** argv) {
  CLI::App app("Fits a fibre-level fracture model of compact bone to a laboratory's tensile tests.",
               "havers");
  word_help(app);
  CommonOptions common;
  common.command_line = typed(argc, argv);
  const std::array commands{
      fit_command(app, common),      simulate_command(app, common), import_command(app, common),
      porosity_command(app, common), check_command(app, common),    synthesize_command(app, common),
      report_command(app, common),   bench_command(app, common),    sweep_command(app, common)};
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text, "version and what is built in");
  app.footer(main_examples);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Parsing failed, so that common.json may not be set yet: the words are searched instead.
    const bool json = std::any_of(
        argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
    return answer(app, error, json);
  }
  for (const Command& command : commands)
    if (command.parser->parsed()) return run(command, common);
  return bad_input;
}

// What was printed may wait in a buffer for a disk that is full.
int when_printed(int exit_code) {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  std::fputs("havers: stdout: cannot be written (is the disk full?)\n", stderr);
  return answer_is_no;
}

}  // namespace
}  // namespace havers::cli

int main(int argc, char** argv) {
  if (fcntl(STDERR_FILENO, F_GETFD) < 0)  // closed: the next file opened would be stderr
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  havers::sim::keep_freed_memory();
  std::signal(SIGCHLD, SIG_DFL);  // a parent that ignores it would hide how gnuplot ended
  std::signal(SIGXFSZ, SIG_IGN);  // a file too large is then said, as a full disk is
  gsl_set_error_handler_off();    // an inverse that is not found is NaN and said, no abort
  try {
    return havers::cli::when_printed(havers::cli::program(argc, argv));
  } catch (...) {  // not even the command line could be read: out of memory
    std::fputs("havers: cannot start\n", stderr);
    return havers::cli::bad_input;
  }
}
