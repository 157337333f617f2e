// havers import: what is in a test file, as read and as used.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/output_folder.hpp"
#include "cli/provenance.hpp"
#include "io/input_error.hpp"

namespace havers::cli {
namespace {

constexpr const char* examples =
    "  havers import A1.csv\n"
    "  havers import *.csv --json\n"
    "  havers import A1.csv --width-mm 4 --thickness-mm 2 --gauge-length-mm 25 -o runs/tests\n";

struct Arguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path folder;
  std::optional<double> width_mm, thickness_mm, gauge_length_mm;
};

struct Imported {
  io::TestFile file;
  calib::Reduction reduction;
};

void override_size(std::optional<double>& size, const std::optional<double>& given_mm) {
  if (given_mm) size = 1e-3 * *given_mm;
}

Imported reduce_one(io::TestFile file, const Arguments& arguments) {
  override_size(file.test.width, arguments.width_mm);
  override_size(file.test.thickness, arguments.thickness_mm);
  override_size(file.test.gauge_length, arguments.gauge_length_mm);
  calib::Reduction reduction = calib::reduce_test(file.test);
  return {std::move(file), std::move(reduction)};
}

// Files that can be read are shown even when others cannot.
std::vector<Imported> import_all(const Arguments& arguments, std::vector<io::Problem>& problems) {
  std::vector<Imported> tests;
  for (const auto& path : arguments.files) {
    try {
      for (io::TestFile& file : io::read_tests(path)) {
        tests.push_back(reduce_one(std::move(file), arguments));
        for (const std::string& problem : tests.back().reduction.problems)
          problems.push_back({path.string(), problem, ""});
      }
    } catch (const io::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  return tests;
}

void print_columns(const io::TestFile& file) {
  fmt::print("{}\n  {}, {}, delimiter '{}', decimal '{}', {} rows\n", file.file, file.layout,
             file.encoding, file.delimiter, file.decimal, file.rows);
  for (const io::Column& column : file.columns)
    fmt::print("  {:<34}{:<10}{}\n", column.name, column.unit, io::to_string(column.quantity));
}

void print_test(const Imported& imported) {
  print_columns(imported.file);
  const calib::MeasuredTest& test = imported.reduction.test;
  if (imported.reduction.problems.empty()) {
    fmt::print(
        "  strength {:.3f} MPa at a strain of {:.4f} %, largest force {:.2f} N on {:.4f} mm2\n",
        1e-6 * test.strength, 100.0 * test.failure_strain, test.max_force, 1e6 * test.area);
    fmt::print("  energy to failure {:.4f} MJ/m3, strain rate {:.4g} 1/s\n",
               1e-6 * test.energy_to_failure, test.strain_rate);
    fmt::print("  modulus {:.3f} +- {:.3f} GPa between strains of {:.4f} and {:.4f} %\n",
               1e-9 * test.modulus, 1e-9 * test.modulus_standard_error, 100.0 * test.window_low,
               100.0 * test.window_high);
  }
  for (const calib::Correction& correction : test.corrections)
    fmt::print("  corrected: {}: {}\n", correction.what, correction.detail);
  for (const auto* list : {&imported.file.test.warnings, &test.warnings})
    for (const std::string& warning : *list) fmt::print("  note: {}\n", warning);
}

nlohmann::json json_of(const std::vector<Imported>& tests) {
  nlohmann::json all = nlohmann::json::array();
  for (const Imported& test : tests) all.push_back(io::import_json(test.file, test.reduction));
  if (all.size() == 1) return all.front();
  return {{"files", all}};
}

// One figure per file; per specimen, with its number, where a file holds several.
std::string figure_name(const std::vector<Imported>& tests, std::size_t i) {
  std::size_t before = 0, all = 0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    if (tests[k].file.file != tests[i].file.file) continue;
    ++all;
    before += k < i ? 1 : 0;
  }
  const std::string stem = std::filesystem::path(tests[i].file.file).stem().string();
  return all == 1 ? stem + ".svg" : fmt::format("{}_{}.svg", stem, before + 1);
}

void write_page(const Arguments& arguments, const std::vector<Imported>& tests,
                const CommonOptions& common, const Stopwatch& watch) {
  OutputFolder output(arguments.folder, common.force);
  io::write_file(output.stage("import.json"), json_of(tests).dump(2) + "\n");
  if (reports::available()) {
    std::vector<reports::ImportReport> pages;
    for (const Imported& imported : tests)
      pages.push_back({imported.file.file, imported.file.test, imported.reduction.test});
    for (std::size_t i = 0; i < pages.size(); ++i)
      io::write_file(output.stage(figure_name(tests, i)), reports::test_svg(pages[i]));
    const io::Provenance provenance = provenance_of(common, arguments.files, watch);
    io::write_file(output.stage("report.html"),
                   reports::import_page(pages, page_facts(provenance)));
  } else {
    note(common, "no figures and no page: this build makes none (havers --version)");
  }
  output.publish();
}

int run_import(const Arguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  std::vector<io::Problem> problems;
  const std::vector<Imported> tests = import_all(arguments, problems);
  if (common.json) {
    fmt::print("{}\n", json_of(tests).dump(2));
  } else {
    for (const Imported& test : tests) print_test(test);
  }
  if (!problems.empty()) throw io::InputError(std::move(problems));
  if (!arguments.folder.empty()) {
    write_page(arguments, tests, common, watch);
    if (!common.json)
      fmt::print(
          "{}\n",
          (arguments.folder / (reports::available() ? "report.html" : "import.json")).string());
  }
  return done;
}

}  // namespace

Command import_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser =
      add_command(app, common, "import", "what is in a test file, as read and as used", examples);
  const auto arguments = std::make_shared<Arguments>();
  parser->add_option("FILE", arguments->files, "test files")->required();
  parser->add_option("-o,--output", arguments->folder, "folder for a page with a figure per file")
      ->type_name("DIR");
  parser->add_option("--width-mm", arguments->width_mm, "instead of the file's")
      ->check(CLI::PositiveNumber);
  parser->add_option("--thickness-mm", arguments->thickness_mm, "instead of the file's")
      ->check(CLI::PositiveNumber);
  parser->add_option("--gauge-length-mm", arguments->gauge_length_mm, "instead of the file's")
      ->check(CLI::PositiveNumber);
  return {parser, [arguments, &common] { return run_import(*arguments, common); }};
}

}  // namespace havers::cli
