// havers bench: which mode the flags ask for.
#include "cli/bench.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/interrupt.hpp"
#include "cli/number_check.hpp"
#include "cli/output_folder.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"

namespace havers::cli {
namespace {

constexpr const char* bench_examples =
    "  havers bench data_samples/scenes/bench.toml -o runs/bench\n"
    "  havers bench data_samples/scenes/bench.toml -o runs/bench --seeds 5 "
    "--set assembly.layers=10\n"
    "  havers bench --stability -o runs/stability   # stiff and extreme scenes of known answer\n"
    "  havers bench --calibration -o runs/chains    # chains of optimisers on studies of known "
    "truth\n";

constexpr int most_repeats = 1'000'000;  // more than anybody waits for

struct Mode {
  const char* name;  // Its flag, but for the mode of a SCENE.
  const char* help;
  BenchMode run;
  std::array<std::string_view, 2> uses{};  // Of `options`.
};

constexpr std::array options{"SCENE", "--seeds", "--studies", "--costly"};

constexpr Mode of_scene{"a SCENE alone", "", bench_scene, {"SCENE", "--seeds"}};

// A new mode needs an entry here and a function in bench.hpp.
constexpr std::array flags{
    Mode{"--stability", "stiff and extreme scenes whose answer is known; needs no SCENE",
         bench_stability},
    Mode{"--calibration",
         "chains of optimisers on studies of known truth; needs no SCENE",
         bench_calibration,
         {"--studies", "--costly"}},
    Mode{"--coverage",
         "whether 95 % intervals hold known truths; needs no SCENE",
         bench_coverage,
         {"--studies"}},
    Mode{"--porosity",
         "ways to measure porosity on drawn sections of known one; needs no SCENE",
         bench_porosity,
         {"--seeds"}},
};

// What other modes use, and the flags of these.
void refuse_idle_options(const CLI::App& parser, const Mode& mode) {
  std::vector<io::Problem> problems;
  const auto refuse = [&](const std::string& option) {
    if (parser.count(option) > 0 && option != mode.name &&
        std::ranges::find(mode.uses, option) == mode.uses.end())
      problems.push_back(
          {option, fmt::format("changes nothing with {}", mode.name), "leave it out"});
  };
  for (const char* option : options) refuse(option);
  for (const Mode& other : flags) refuse(other.name);
  if (!problems.empty()) throw io::InputError(std::move(problems));
}

int run_mode(const CLI::App& parser, const Mode& mode, const BenchArguments& arguments,
             const CommonOptions& common) {
  refuse_idle_options(parser, mode);
  if (&mode != &of_scene)
    refuse_settings(common, fmt::format("{} has settings of its own", mode.name));
  catch_interrupts();
  return mode.run(arguments, common);
}

}  // namespace

void leave(const BenchFiles& files, const CommonOptions& common, OutputFolder& output,
           const std::function<void()>& print) {
  output.write("result.json", io::json_text(files.result));
  output.write(files.csv_name, files.csv);
  if (!files.page.empty()) output.write("report.html", files.page);
  answer(common, &output, files.result, files.page.empty() ? "result.json" : "report.html", print);
}

Command bench_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "bench", "error against run time", bench_examples);
  const auto arguments = std::make_shared<BenchArguments>();
  // If several flags are given one of them is chosen, and run_mode refuses the others as idle.
  const auto chosen = std::make_shared<const Mode*>(&of_scene);
  parser->add_option("SCENE", arguments->scene, "scene file (TOML)");
  add_output(*parser, arguments->folder, "folder for the results")->required();
  parser
      ->add_option("--seeds", arguments->seeds,
                   "runs of each setting, with --porosity drawn sections of each kind (default: 3)")
      ->type_name("N")
      ->check(count(most_repeats));
  parser
      ->add_option("--studies", arguments->studies,
                   "studies of known truth (default: 20 with --calibration, 100 with --coverage)")
      ->type_name("N")
      ->check(count(most_repeats));
  parser
      ->add_option("--costly", arguments->costly,
                   "with --calibration, unknowns that cost simulations: 1, the ratio (default), or "
                   "2, ratio and scatter")
      ->type_name("N")
      ->check(count(2));
  for (const Mode& flag : flags)
    parser->add_flag_callback(
        flag.name, [chosen, &flag] { *chosen = &flag; }, flag.help);
  return {parser, [parser, arguments, chosen, &common] {
            return run_mode(*parser, **chosen, *arguments, common);
          }};
}

}  // namespace havers::cli
