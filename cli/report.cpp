// havers report: the page of a finished fit again, or several fits side by side.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.hpp"
#include "cli/fit_files.hpp"
#include "io/input_error.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* report_examples =
    "  havers report runs/first                            # remakes runs/first/report.html\n"
    "  havers report runs/first runs/second -o runs/both   # side by side\n";

struct ReportArguments {
  std::vector<fs::path> results;
  fs::path folder;
};

// The ends of paths, as short as tell apart those that differ: runs/first/out, runs/second/out.
std::vector<std::string> shortest_ends(const std::vector<fs::path>& folders) {
  std::vector<fs::path> rest(folders.size()), ends(folders.size());
  std::ranges::transform(folders, rest.begin(), [](const fs::path& p) { return fs::canonical(p); });
  const std::set<fs::path> different(rest.begin(), rest.end());
  // Each turn takes one more part of the paths, until there are as many ends as folders.
  do {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      ends[i] = ends[i].empty() ? rest[i].filename() : rest[i].filename() / ends[i];
      rest[i] = rest[i].parent_path();
    }
  } while (std::set<fs::path>(ends.begin(), ends.end()).size() < different.size());
  std::vector<std::string> names(ends.size());
  std::ranges::transform(ends, names.begin(), [](const fs::path& end) { return end.string(); });
  return names;
}

// Fits of studies of one name are called by their folders.
void tell_apart(std::vector<FinishedFit>& fits, const std::vector<fs::path>& folders) {
  std::map<std::string, int> fits_of;
  for (const FinishedFit& finished : fits) ++fits_of[finished.fit.study.name];
  const std::vector<std::string> ends = shortest_ends(folders);
  std::set<std::string> used;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    std::string& name = fits[i].fit.study.name;
    if (fits_of[name] > 1) name = fmt::format("{} ({})", name_of_its_own(ends[i], used), name);
  }
}

// Throws the problems of all results at once.
std::vector<FinishedFit> read_all(const std::vector<fs::path>& results) {
  std::vector<FinishedFit> fits;
  std::vector<fs::path> folders;
  std::vector<io::Problem> problems;
  for (const fs::path& path : results) {
    try {
      fits.push_back(read_fit(path));
      folders.push_back(folder_of_fit(path));
    } catch (const io::InputError& error) {
      io::collect(problems, error.problems());
    }
  }
  if (!problems.empty()) throw io::InputError(std::move(problems));
  tell_apart(fits, folders);
  return fits;
}

std::string page_of(const std::vector<FinishedFit>& fits) {
  if (fits.size() == 1) return reports::fit_page(fits.front().report());
  std::vector<reports::FitReport> reports;
  reports.reserve(fits.size());
  for (const FinishedFit& fit : fits) reports.push_back(fit.report());
  return reports::comparison_page(reports);
}

// One result: beside it, in place of the old page. Several: into a folder of their own.
fs::path write_page(const ReportArguments& arguments, const std::vector<FinishedFit>& fits,
                    bool force) {
  if (arguments.folder.empty()) {
    const fs::path page = folder_of_fit(arguments.results.front()) / "report.html";
    io::write_file(page, page_of(fits));
    // Noted, so that a later run may replace the page even if the fit was made without one.
    take_note(page.parent_path(), page.filename().string());
    return fs::absolute(page).lexically_normal();
  }
  OutputFolder output(arguments.folder, force);
  output.write("report.html", page_of(fits));
  output.publish(OutputFolder::Earlier::stays);  // A fit in that folder is kept.
  return output.folder() / "report.html";
}

int run_report(const ReportArguments& arguments, const CommonOptions& common) {
  refuse_settings(common, "havers report shows fits as they were");
  if (!reports::available())
    throw io::InputError("report", "this build makes no pages",
                         "apt-get install libmstch-dev gnuplot-nox and build again");
  if (arguments.results.size() > 1 && arguments.folder.empty())
    throw io::InputError("report", "several results need a folder for their page", "add -o DIR");
  const std::vector<FinishedFit> fits = read_all(arguments.results);
  const fs::path page = write_page(arguments, fits, common.force);
  if (common.json)
    fmt::print("{}",
               io::json_text(nlohmann::json{{"report", page.string()}, {"results", fits.size()}}));
  else
    fmt::print("{}\n", page.string());
  return done;
}

}  // namespace

Command report_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(
      app, common, "report", "a fit's page again, or several fits side by side", report_examples);
  say_settings_are_refused(*parser);
  const auto arguments = std::make_shared<ReportArguments>();
  parser->add_option("RESULT", arguments->results, "folder of a fit, or its result.json")
      ->required();
  add_output(*parser, arguments->folder, "folder for the page");
  return {parser, [arguments, &common] { return run_report(*arguments, common); }};
}

}  // namespace havers::cli
