// The cost of a fit, computed again by hand from the CSV files it leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<Row> rows_of(const fs::path& file) {
  std::istringstream in(test::contents(file));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

double at(const Row& row, const std::string& name) {
  return std::stod(row.at(name));
}

struct Logs {
  double mean = 0.0, variance = 0.0, n = 0.0;
};

Logs log_strengths(const std::vector<Row>& replicates, const std::string& specimen) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (const Row& replicate : replicates) {
    if (replicate.at("specimen") != specimen) continue;
    const double y = std::log(at(replicate, "strength_Pa"));
    sum += y;
    squares += y * y;
    ++n;
  }
  return {sum / n, std::max((squares - sum * sum / n) / (n - 1.0), 0.0), n};
}

// Over the specimens of an orientation, in proportion to their scatter.
double pooled_sd(const nlohmann::json& specimens, const std::vector<Row>& replicates,
                 const std::string& id) {
  double orientation = 0.0, scatter = 0.0, squares = 0.0, freedom = 0.0;
  for (const auto& specimen : specimens)
    if (specimen["id"] == id) {
      orientation = specimen["orientation_deg"];
      scatter = specimen["scatter"];
    }
  for (const auto& specimen : specimens) {
    if (specimen["orientation_deg"] != orientation) continue;
    const Logs logs = log_strengths(replicates, specimen["id"]);
    squares += (logs.n - 1.0) * logs.variance / std::pow(specimen["scatter"].get<double>(), 2);
    freedom += logs.n - 1.0;
  }
  return scatter * std::sqrt(squares / freedom);
}

// (F5) The largest stress, and half of what a row adds, by the five before: these bars parted
// between two rows.
double strength_of(const std::vector<Row>& curve) {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (at(curve[i], "stress_Pa") > at(curve[peak], "stress_Pa")) peak = i;
  const double top = at(curve.at(peak), "stress_Pa");
  const double row = (top - at(curve.at(peak - 5), "stress_Pa")) / 5.0;
  return top + 0.5 * row;
}

TEST(Objective, CanBeComputedByHandFromTheFilesOfAFit) {
  HAVERS_SLOW;
  const fs::path folder = test::own_folder();
  const auto answer = test::run_havers(
      folder, "fit '" HAVERS_SOURCE_DIR
              "/data_samples/bone_bars/study.toml' -o out --json --set "
              "calibrate.options.replicates=3 --set calibrate.options.profiles=false");
  const auto result = nlohmann::json::parse(answer.out);
  const auto replicates = rows_of(folder / "out/replicates.csv");

  double cost = 0.0, shares = 0.0;
  int strengths = 0;
  for (const Row& term : rows_of(folder / "out/terms.csv")) {
    double variance = 0.0;
    for (const char* source :
         {"sd_machine", "sd_replicates", "sd_scatter", "sd_specimens", "sd_parameters"})
      variance += std::pow(at(term, source), 2);
    const double residual = (at(term, "simulated") - at(term, "measured")) / std::sqrt(variance);
    EXPECT_NEAR(at(term, "residual"), residual, 1e-9);
    cost += 0.5 * residual * residual;
    shares += at(term, "share");
    if (term.at("term") != "strength") continue;

    // The mean over the replicates, and their spread as one draw against a mean of n.
    ++strengths;
    const Logs logs = log_strengths(replicates, term.at("specimen"));
    EXPECT_EQ(logs.n, 3.0);
    EXPECT_NEAR(at(term, "simulated"), logs.mean, 1e-12);
    EXPECT_NEAR(at(term, "sd_replicates"),
                pooled_sd(result["specimens"], replicates, term.at("specimen")) *
                    std::sqrt(1.0 + 1.0 / logs.n),
                1e-6);

    const auto curve = rows_of(folder / "out/curves" / (term.at("specimen") + "_measured.csv"));
    EXPECT_NEAR(at(term, "measured"), std::log(strength_of(curve)), 1e-9);
  }
  EXPECT_EQ(strengths, 6);
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_NEAR(cost / result["cost"].get<double>(), 1.0, 1e-9);
}

}  // namespace
}  // namespace havers
