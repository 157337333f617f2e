// havers import: what is in a test file, as read and as used.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "calib/decimals.hpp"
#include "calib/experiment/join_logger.hpp"
#include "cli/command.hpp"
#include "cli/number_check.hpp"
#include "cli/output_folder.hpp"
#include "cli/provenance.hpp"
#include "io/config/key_unit.hpp"
#include "io/config/read_import.hpp"
#include "io/input_error.hpp"
#include "io/results/result_files.hpp"
#include "reports/pages.hpp"

namespace havers::cli {
namespace {

constexpr const char* import_examples =
    "  havers import data_samples/bone_bars/A1.csv\n"
    "  havers import data_samples/bone_bars/*.csv --json\n"
    "  havers import my/A1.csv --width-mm 4 --thickness-mm 2 --gauge-length-mm 25 -o runs/tests\n"
    "  havers import my/A1.csv --gauge my/A1_logger.csv -o runs/A1   # a logger with its own "
    "clock\n"
    "  havers import my/A1.csv --set columns.force=2 --set columns.force_unit=kN\n"
    "  havers import my/A1.csv --set reduction.remove_toe=false\n";

struct ImportArguments {
  std::vector<std::filesystem::path> files;
  std::optional<std::filesystem::path> gauge;
  std::filesystem::path folder;
  std::optional<double> width_mm, thickness_mm, gauge_length_mm;
};

struct Imported {
  io::TestFile file;                      // with the gauge of the second logger, where there is one
  std::optional<calib::ClockFit> clocks;  // where there is something to show
  calib::Reduction reduction;
};

// What all files gave, those that could not be read among them.
struct ImportFindings {
  std::vector<Imported> tests;
  std::vector<io::Problem> problems;
  std::vector<std::filesystem::path> read;
  nlohmann::json entries = nlohmann::json::array();  // an object a test, or a file's error
};

// Without an option the size of the settings or of the file stays.
void give_size(std::optional<double>& size, const std::optional<double>& given_mm) {
  if (given_mm) size = io::to_si(*given_mm, io::millimetre);
}

void give_sizes(io::ReadOptions& options, const ImportArguments& arguments) {
  give_size(options.width, arguments.width_mm);
  give_size(options.thickness, arguments.thickness_mm);
  give_size(options.gauge_length, arguments.gauge_length_mm);
}

Imported reduced(io::TestFile file, const calib::ReductionOptions& options) {
  calib::Reduction reduction = calib::reduce_test(file.test, options);
  return {std::move(file), {}, std::move(reduction)};
}

std::vector<Imported> import_tests(const std::filesystem::path& path,
                                   const io::ImportSettings& settings) {
  std::vector<Imported> tests;
  for (io::TestFile& file : io::read_tests(path, settings.columns))
    tests.push_back(reduced(std::move(file), settings.reduction));
  return tests;
}

// One test from two recorders. If these cannot be joined the reasons are stated as problems of the
// reduction, and the test is shown as recorded.
Imported import_joined(io::ImportSettings settings, const ImportArguments& arguments) {
  settings.columns.has_logger = true;
  io::TestFile file = io::read_test(arguments.files.front(), settings.columns);
  const io::TestFile logger = io::read_test(*arguments.gauge, settings.gauge_columns);
  calib::JoinedTest joined = calib::join_logger(file.test, logger.test, settings.reduction);
  file.test = std::move(joined.test);
  const std::string &own = file.test.specimen_id, &other = logger.test.specimen_id;
  if (!own.empty() && !other.empty() && own != other)
    file.test.warnings.push_back(
        fmt::format("{} is of specimen {} by its own words, and {} of {}: are they of one test?",
                    logger.file, other, file.file, own));
  Imported imported{std::move(file), {}, {{}, std::move(joined.problems)}};
  if (!joined.clocks.machine.time.empty()) imported.clocks = std::move(joined.clocks);
  if (imported.reduction.problems.empty()) {
    imported.reduction = calib::reduce_test(imported.file.test, settings.reduction);
  } else {
    imported.reduction.test.corrections = imported.file.test.corrections;
    imported.reduction.test.warnings = imported.file.test.warnings;
  }
  return imported;
}

// The file and its specimen, which has a number in it where it has no name.
std::string title_of(const io::TestFile& file) {
  if (!file.test.specimen_id.empty())
    return fmt::format("{}, specimen {}", file.file, file.test.specimen_id);
  return file.specimens == 1 ? file.file
                             : fmt::format("{}, specimen {} in it", file.file, file.number);
}

// What is wrong with one of several specimens names it.
void collect(const std::vector<Imported>& tests, std::vector<io::Problem>& problems) {
  for (const Imported& test : tests) {
    const calib::RawTest& raw = test.file.test;
    // Options for sizes are suggested only if a size is missing.
    const bool sized = raw.area || (raw.width && raw.thickness) || !raw.stress.empty();
    const bool strained = raw.gauge_length || !raw.strain.empty() || raw.extension.empty();
    const std::string where = tests.size() == 1 ? test.file.file : title_of(test.file);
    for (const std::string& problem : test.reduction.problems)
      problems.push_back({where, problem,
                          sized && strained
                              ? ""
                              : "--width-mm, --thickness-mm, --gauge-length-mm give sizes "
                                "that the file lacks"});
  }
}

// Machine time = offset_s + rate · logger time. ClockFit has its offset at `reference`; offset_s is
// the offset at logger time 0.
nlohmann::json clocks_json(const calib::ClockFit& clocks) {
  return {{"offset_s", clocks.offset - clocks.rate * clocks.reference},
          {"rate", clocks.rate},
          {"rate_fitted", clocks.rate_fitted},
          {"rate_standard_error", clocks.rate_standard_error},
          {"reference_s", clocks.reference},
          {"machine_time_at_reference_s", clocks.offset},
          {"machine_time_standard_error_s", clocks.offset_standard_error},
          {"correlation", clocks.correlation}};
}

// Files that can be read are shown even when others cannot.
ImportFindings import_all(const ImportArguments& arguments, const io::ImportSettings& settings) {
  ImportFindings found;
  for (const auto& path : arguments.files) {
    try {
      std::vector<Imported> tests;
      if (arguments.gauge)
        tests.push_back(import_joined(settings, arguments));
      else
        tests = import_tests(path, settings);
      collect(tests, found.problems);
      for (const Imported& test : tests) {
        found.entries.push_back(io::import_json(test.file, test.reduction));
        if (test.clocks) found.entries.back()["clocks"] = clocks_json(*test.clocks);
      }
      std::ranges::move(tests, std::back_inserter(found.tests));
      found.read.push_back(path);
    } catch (const io::InputError& error) {
      found.entries.push_back({{"file", path.string()}, {"error", error.what()}});
      io::collect(found.problems, error.problems());
    }
  }
  return found;
}

void print_columns(const io::TestFile& file) {
  fmt::print("{}\n  {}, {}, delimiter '{}', decimal '{}', {} rows\n", title_of(file), file.layout,
             file.encoding, file.delimiter == "\t" ? "tab" : file.delimiter, file.decimal,
             file.rows);
  for (const io::Column& column : file.columns)
    fmt::print("  {:<34} {:<10} {}\n", column.name, column.unit, io::to_string(column.quantity));
}

// To the second digit of the error.
std::string with_error(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return fmt::format("{:.4g} +- -", value);
  const int decimals = std::min(calib::decimals_for(error), 9);
  return fmt::format("{:.{}f} +- {:.{}f}", value, decimals, error, decimals);
}

void print_test(const Imported& imported) {
  print_columns(imported.file);
  const calib::MeasuredTest& test = imported.reduction.test;
  if (!test.strain.empty()) {
    fmt::print(
        "  strength {}{} MPa at a strain of {:.4g} %{}\n", test.broke ? "" : "at least ",
        with_error(1e-6 * test.strength, 1e-6 * test.strength_standard_error),
        100.0 * test.failure_strain,
        test.max_force > 0.0 && test.area > 0.0
            ? fmt::format(", largest force {:.2f} N on {:.4f} mm2", test.max_force, 1e6 * test.area)
            : "");
    fmt::print("  energy to failure {:.4g} MJ/m3{}\n", 1e-6 * test.energy_to_failure,
               test.time.empty() ? "" : fmt::format(", strain rate {:.4g} 1/s", test.strain_rate));
    fmt::print("  modulus {} GPa between strains of {:.4g} and {:.4g} %\n",
               with_error(1e-9 * test.modulus, 1e-9 * test.modulus_standard_error),
               100.0 * test.window_low, 100.0 * test.window_high);
  }
  for (const calib::Correction& correction : test.corrections)
    fmt::print("  corrected: {}: {}\n", correction.what, correction.detail);
  for (const std::string& warning : test.warnings) fmt::print("  note: {}\n", warning);
}

// One figure per file; per specimen, with its number, where a file holds several.
std::string figure_name(const std::vector<Imported>& tests, std::size_t i) {
  // How many tests of the same file come before this one, and how many there are.
  std::size_t before = 0, all = 0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    if (tests[k].file.file != tests[i].file.file) continue;
    ++all;
    before += k < i ? 1 : 0;
  }
  const std::string stem = std::filesystem::path(tests[i].file.file).stem().string();
  return all == 1 ? stem : fmt::format("{}_{}", stem, before + 1);
}

void write_figures(const OutputFolder& output, const std::vector<Imported>& tests,
                   const calib::Provenance& provenance) {
  std::vector<reports::ImportReport> pages;
  pages.reserve(tests.size());
  for (const Imported& test : tests)
    pages.push_back({test.file.file, test.file.test, test.reduction.test, test.reduction.problems,
                     test.clocks ? &*test.clocks : nullptr});
  // Files in different folders may share a name.
  std::set<std::string> used;
  const auto write = [&](const std::string& name, const std::string& svg) {
    output.write(name_of_its_own(name, used) + ".svg", svg);
  };
  for (std::size_t i = 0; i < pages.size(); ++i) {
    write(figure_name(tests, i), reports::test_svg(pages[i]));
    if (pages[i].clocks != nullptr) write("clocks", reports::clocks_svg(*pages[i].clocks));
  }
  output.write("report.html", reports::import_page(pages, provenance));
}

void write_results(const OutputFolder& output, const ImportArguments& arguments,
                   ImportFindings& found, const CommonOptions& common, const Stopwatch& watch) {
  if (arguments.gauge) found.read.push_back(*arguments.gauge);
  if (reports::available())
    write_figures(output, found.tests, provenance_of(common, digests_of(found.read), watch));
  else
    note(common, "no figures and no page: this build makes none (havers --version)");
}

int run_import(const ImportArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  note_idle_seed(common, "havers import draws nothing");
  io::ImportSettings settings = io::read_import_settings(common.set);
  give_sizes(settings.columns, arguments);
  give_sizes(settings.gauge_columns, arguments);
  if (arguments.gauge && arguments.files.size() != 1)
    throw io::InputError("--gauge", "is the second file of one test", "import the others alone");
  std::vector<std::filesystem::path> inputs = arguments.files;
  if (arguments.gauge) inputs.push_back(*arguments.gauge);
  std::optional<OutputFolder> output;  // refused before anything is read
  if (!arguments.folder.empty()) output.emplace(arguments.folder, common.force, inputs);
  ImportFindings found = import_all(arguments, settings);
  const nlohmann::json json = json_of_files("files", found.entries, arguments.files.size());
  // Without any test no folder is made.
  if (found.tests.empty()) output.reset();
  if (output) output->write("import.json", io::json_text(json));
  if (output) write_results(*output, arguments, found, common, watch);
  answer(common, output ? &*output : nullptr, json, page_or("import.json"), [&] {
    for (const Imported& test : found.tests) print_test(test);
  });
  // Last, so that what could be read is shown before; the JSON has the problems already.
  return found.problems.empty() ? done : refuse(io::InputError(std::move(found.problems)));
}

}  // namespace

Command import_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "import",
                                 "what is in a test file, as read and as used", import_examples);
  say_seed_is_idle(*parser);
  parser->get_option("--set")->description(
      "how files are read: columns.KEY, gauge_columns.KEY, specimen_in_file or reduction.KEY, as "
      "in a study; repeatable");
  const auto arguments = std::make_shared<ImportArguments>();
  parser->add_option("FILE", arguments->files, "test files")->required();
  parser
      ->add_option("--gauge", arguments->gauge,
                   "second logger's file of one test, with a clock of its own")
      ->type_name("FILE");
  add_output(*parser, arguments->folder, "folder for a page with a figure per file");
  parser->add_option("--width-mm", arguments->width_mm, "instead of the file's")
      ->check(above_zero());
  parser->add_option("--thickness-mm", arguments->thickness_mm, "instead of the file's")
      ->check(above_zero());
  parser->add_option("--gauge-length-mm", arguments->gauge_length_mm, "instead of the file's")
      ->check(above_zero());
  return {parser, [arguments, &common] { return run_import(*arguments, common); }};
}

}  // namespace havers::cli
