// havers bench: which mode the flags ask for.
#include "cli/bench.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>

#include "cli/number_check.hpp"

namespace havers::cli {
namespace {

constexpr const char* bench_examples =
    "  havers bench data_samples/scenes/bench.toml -o runs/bench\n"
    "  havers bench data_samples/scenes/bench.toml -o runs/bench --seeds 5 "
    "--set assembly.layers=10\n"
    "  havers bench --stability -o runs/stability   # stiff and extreme scenes of known answer\n"
    "  havers bench --calibration -o runs/chains    # chains of optimisers on studies of known "
    "truth\n";

struct Flag {
  const char* name;
  const char* help;
  BenchMode run;
};

constexpr std::array flags{
    Flag{"--stability", "stiff and extreme scenes whose answer is known; needs no SCENE",
         bench_stability},
    Flag{"--calibration", "chains of optimisers on studies of known truth; needs no SCENE",
         bench_calibration},
    Flag{"--coverage", "whether 95 % intervals hold known truths; needs no SCENE", bench_coverage},
    Flag{"--porosity", "ways to measure porosity on drawn sections of known one; needs no SCENE",
         bench_porosity},
};

int run_mode(const Flag& flag, const BenchArguments& arguments, const CommonOptions& common) {
  refuse_settings(common, fmt::format("{} has settings of its own", flag.name));
  if (!arguments.scene.empty())
    note(common, fmt::format("{} is not run: {} has scenes of its own", arguments.scene.string(),
                             flag.name));
  return flag.run(arguments, common);
}

}  // namespace

Command bench_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "bench", "error against run time", bench_examples);
  const auto arguments = std::make_shared<BenchArguments>();
  const auto chosen = std::make_shared<const Flag*>(nullptr);
  parser->add_option("SCENE", arguments->scene, "scene file (TOML)");
  add_output(*parser, arguments->folder, "folder for the results")->required();
  parser
      ->add_option("--seeds", arguments->seeds,
                   "runs of each setting, with --porosity drawn sections of each kind (default: 3)")
      ->type_name("N")
      ->check(count());
  parser
      ->add_option("--studies", arguments->studies,
                   "studies of known truth (default: 20 with --calibration, 100 with --coverage)")
      ->type_name("N")
      ->check(count());
  parser
      ->add_option("--costly", arguments->costly,
                   "with --calibration, unknowns that cost simulations: 1, the ratio (default), or "
                   "2, ratio and scatter")
      ->type_name("N")
      ->check(count(2));
  for (const Flag& flag : flags)
    parser->add_flag_callback(
        flag.name, [chosen, &flag] { *chosen = &flag; }, flag.help);
  return {parser, [arguments, chosen, &common] {
            return *chosen == nullptr ? bench_scene(*arguments, common)
                                      : run_mode(**chosen, *arguments, common);
          }};
}

}  // namespace havers::cli
