// The file is read once for the plan and its questions, and then once more for every point, with
// the point's values on top as if by --set, so that every scene passes all checks of a scene file.
#include "io/sweep/read_sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "io/config/file_kind.hpp"
#include "io/config/parse_toml.hpp"
#include "io/config/scene_tables.hpp"
#include "io/sweep/sweep_keys.hpp"

namespace havers::io {
namespace {

// Keys by which thresholds are drawn.
constexpr std::array drawn_by{"joints.scatter", "joints.distribution", "joints.missing"};

void read_plan(TableReader& top, calib::Sweep& sweep) {
  TableReader table = top.table("sweep");
  table.key("name", sweep.name);
  table.key("text", sweep.text);
  table.key("sample", sweep.plan.sampling);
  table.key("points", sweep.plan.points);
  table.key("seeds", sweep.plan.seeds);
  table.key("seed", sweep.plan.seed);
  table.key("levels", sweep.levels);
  table.key("patterns", sweep.patterns);
  if (sweep.levels < 1 || sweep.levels > 2) table.complain("levels", "must be 1 or 2");
  for (auto& [name, values] : table.lists("keys"))
    sweep.plan.keys.push_back({name, std::move(values)});
  for (const auto& problem : sweep.plan.problems()) table.complain(problem.key, problem.what);
  for (const calib::SweepKey& key : sweep.plan.keys)
    if (key.name == "joints.seed" || key.name.starts_with("sweep."))
      table.complain("keys", fmt::format("{} cannot vary", key.name),
                     key.name == "joints.seed" ? "give sweep.seed and sweep.seeds instead"
                                               : "only keys of the scene can");
}

// Thresholds that are given leave nothing to draw.
void check_thresholds(TableReader& top, const calib::Sweep& sweep) {
  if (!top.table("joints").has("thresholds_file")) return;
  TableReader table = top.table("sweep");
  for (const calib::SweepKey& key : sweep.plan.keys)
    if (std::ranges::find(drawn_by, key.name) != drawn_by.end())
      table.complain("keys", key.name + " changes nothing beside joints.thresholds_file",
                     "leave out one of them");
  if (sweep.plan.seeds > 1 || sweep.levels > 1)
    table.complain(sweep.levels > 1 ? "levels" : "seeds",
                   "asks for draws that joints.thresholds_file leaves no room for",
                   "leave out one of them");
}

// Every point puts its own value on top.
std::vector<Problem> settings_of_varied_keys(const Overrides& overrides,
                                             const calib::SweepPlan& plan) {
  const toml::table set = parse_toml({}, overrides);
  std::vector<Problem> problems;
  for (const calib::SweepKey& key : plan.keys)
    if (set.at_path(key.name))
      problems.push_back(
          {std::string(override_mark) + key.name, "sets nothing: the sweep varies it",
           fmt::format("--set 'sweep.keys.\"{}\"=[...]' gives its values", key.name)});
  return problems;
}

// Keys of a scene or of a sample that were pasted along.
std::vector<std::string> idle_keys_of_sweep(TableReader& top, const calib::SweepPlan& plan) {
  std::vector<std::string> warnings;
  if (top.table("joints").has("seed"))
    warnings.emplace_back("joints.seed changes nothing: sweep.seed and sweep.seeds choose them");
  if (plan.seeds == 1 && !top.tables("finding").empty())
    warnings.emplace_back("sweep.seeds is 1: no finding can be decided; give 2 or more");
  if (!is_sample(plan.sampling) && top.table("sweep").has("points"))
    warnings.emplace_back("sweep.points changes nothing: a list or a grid has those of its keys");
  return warnings;
}

// What the scenes of all points are in doubt of, whatever varies.
std::vector<std::string> doubts_of_all_points(const calib::Sweep& sweep) {
  std::vector<std::string> doubts = sweep.points.front().scene.doubts();
  for (const calib::SweepPoint& point : sweep.points)
    std::erase_if(doubts, [others = point.scene.doubts()](const std::string& doubt) {
      return std::ranges::find(others, doubt) == others.end();
    });
  for (const calib::SweepKey& key : sweep.plan.keys)
    std::erase_if(doubts, [&](const std::string& doubt) { return doubt.starts_with(key.name); });
  return doubts;
}

// Keys that the limit does not know, where every point asks for it.
std::vector<std::string> idle_keys_of_the_limit(const calib::Sweep& sweep) {
  constexpr std::array of_time{
      "material.density_kg_m3", "material.viscosity_s", "loading.strain_rate_per_s",
      "loading.start",          "solver.step_s",        "solver.step_accuracy",
      "solver.contact"};
  std::vector<std::string> warnings;
  for (const calib::SweepKey& key : sweep.plan.keys)
    if (std::ranges::find(of_time, key.name) != of_time.end() &&
        std::ranges::all_of(sweep.points, [](const calib::SweepPoint& point) {
          return point.scene.solver.regime == sim::Regime::quasi_static;
        }))
      warnings.push_back(fmt::format(
          "sweep.keys.\"{}\" changes nothing: solver.regime is quasi-static, and the limit has no "
          "time",
          key.name));
  return warnings;
}

// A key that a question is about must be one of those that vary.
void require_varied(TableReader& table, const calib::SweepPlan& plan, const std::string& key,
                    const char* name) {
  if (!key.empty() && plan.column(key) == plan.keys.size())
    table.complain(name, fmt::format("names {}, which does not vary", key),
                   "name a key of [sweep.keys]");
}

// The same of a key that stands for a number.
void require_number(TableReader& table, const calib::SweepPlan& plan, const std::string& key,
                    const char* name) {
  require_varied(table, plan, key, name);
  const auto is_word = [](const std::string& value) { return std::isnan(calib::number_in(value)); };
  const std::size_t column = plan.column(key);
  if (column < plan.keys.size() && std::ranges::any_of(plan.keys[column].values, is_word))
    table.complain(name, fmt::format("names {}, whose values are no numbers", key),
                   "name a key with numbers, or give one of words as per");
}

// What is read off the broken joints is known only where they are looked at.
void require_looked_at(TableReader& table, const calib::Sweep& sweep, calib::Measure response) {
  if (!sweep.patterns && response >= calib::Measure::head_tail_broken)
    table.complain("response", "is known only where the broken joints are looked at",
                   "say patterns = true in [sweep]");
}

// A difference is judged over one key, the others held; a line may have several.
void require_as_many_keys_as_are_judged(TableReader& table, const calib::FindingRequest& finding) {
  if (finding.test > calib::FindingTest::linear) return;  // judges a mean or a spread
  if (finding.keys.empty())
    table.complain("keys", "is missing", "name the key whose effect is judged");
  else if (finding.keys.size() > 1 && finding.test != calib::FindingTest::linear)
    table.complain("keys",
                   fmt::format("names {} keys, of which one is judged", finding.keys.size()),
                   "give each a finding of its own");
}

void read_questions(TableReader& top, calib::Sweep& sweep) {
  for (TableReader& table : top.tables("law")) {
    calib::LawRequest& law = sweep.laws.emplace_back();
    keys(table, law);
    require_looked_at(table, sweep, law.response);
    for (const std::string& term : law.terms) require_number(table, sweep.plan, term, "terms");
    require_varied(table, sweep.plan, law.per, "per");
  }
  for (TableReader& table : top.tables("finding")) {
    calib::FindingRequest& finding = sweep.findings.emplace_back();
    keys(table, finding);
    require_looked_at(table, sweep, finding.response);
    const bool in_order = finding.test == calib::FindingTest::rises ||
                          finding.test == calib::FindingTest::falls ||
                          finding.test == calib::FindingTest::linear;
    for (const std::string& key : finding.keys)
      (in_order ? require_number : require_varied)(table, sweep.plan, key, "keys");
    require_varied(table, sweep.plan, finding.per, "per");
    require_as_many_keys_as_are_judged(table, finding);
    if (judges_means(finding.test) && !table.has("margin"))
      table.complain("margin", "is missing", "give the level, in the response's SI unit");
    if (!judges_means(finding.test) && !(finding.margin >= 0.0 && finding.margin < 1.0))
      table.complain("margin",
                     fmt::format("is {:g}, must be at least 0 and less than 1", finding.margin),
                     "give a part, 0.05 for 5 %");
  }
  for (TableReader& table : top.tables("figure")) {
    calib::SweepFigure& figure = sweep.figures.emplace_back();
    keys(table, figure);
    require_looked_at(table, sweep, figure.response);
    require_number(table, sweep.plan, figure.x, "x");
    require_varied(table, sweep.plan, figure.series, "series");
    require_varied(table, sweep.plan, figure.per, "per");
  }
}

// A TOML value as a reader of results knows it: a text without its quotes.
std::string without_quotes(const std::string& value) {
  return parse_toml({}, {"value=" + value})["value"].value_or(value);
}

calib::SweepPoint without_scene(const std::vector<std::string>& values) {
  calib::SweepPoint point;
  for (const std::string& value : values) {
    point.numbers.push_back(calib::number_in(value));
    point.values.push_back(without_quotes(value));
  }
  return point;
}

// What would be undecided however the runs end. Whether a finding's keys vary is asked elsewhere.
std::vector<Problem> findings_without_comparison(const std::filesystem::path& file,
                                                 const calib::Sweep& sweep) {
  const calib::SweepPlan& plan = sweep.plan;
  const auto varies = [&](const std::string& key) { return plan.column(key) < plan.keys.size(); };
  std::vector<calib::SweepPoint> points;
  for (const auto& values : points_of(plan)) points.push_back(without_scene(values));
  std::vector<Problem> problems;
  for (const calib::FindingRequest& finding : sweep.findings) {
    const bool of_keys = finding.test <= calib::FindingTest::linear;  // differences or a line
    if (!of_keys || finding.keys.empty() || !std::ranges::all_of(finding.keys, varies)) continue;
    const auto group = group_without_comparison(finding, plan, points);
    if (!group) continue;
    const bool linear = finding.test == calib::FindingTest::linear;
    const bool by_itself = std::ranges::find(finding.keys, finding.per) != finding.keys.end();
    problems.push_back(
        {fmt::format("{}: finding.keys", file.string()),
         fmt::format(
             "names {}, but {}{}", fmt::join(finding.keys, " and "),
             finding.per.empty() ? "" : fmt::format("at {} = {} ", finding.per, group->value),
             linear ? "the points are too few or too alike to try a line by"
                    : "no two points differ in it alone"),
         by_itself                  ? "name another key as per"
         : is_sample(plan.sampling) ? R"(use sample = "grid" or "list")"
                                    : "give it more values at which the other keys are alike"});
  }
  return problems;
}

// The scene with a point's values on top, as if they were given by --set.
calib::SweepPoint read_point(SweepFile& read, Overrides overrides,
                             const std::vector<std::string>& values) {
  const calib::SweepPlan& plan = read.sweep.plan;
  for (std::size_t i = 0; i < values.size(); ++i)
    overrides.push_back(fmt::format("{}={}", plan.keys[i].name, values[i]));
  ConfigFile config(read.inputs.front(), overrides);
  TableReader top = config.top();
  calib::Sweep again;  // read again only so that the sweep's own keys are known
  read_plan(top, again);
  check_thresholds(top, again);
  read_questions(top, again);
  calib::SweepPoint point = without_scene(values);
  read_scene_tables(top, point.scene);
  config.finish();
  for (const std::filesystem::path& input : config.inputs())
    if (std::ranges::find(read.inputs, input) == read.inputs.end()) read.inputs.push_back(input);
  point.inertia_number = calib::inertia_of(point.scene);
  return point;
}

// What is wrong with a point's value, or with a table that its key names, is said of the sweep's
// key.
Problem of_sweep(Problem problem, const std::filesystem::path& file, const calib::SweepPlan& plan) {
  for (const calib::SweepKey& key : plan.keys)
    if (fmt::format("{}{}.", override_mark, key.name).starts_with(problem.where + "."))
      problem.where = fmt::format("{}: sweep.keys.\"{}\"", file.string(), key.name);
  return problem;
}

}  // namespace

SweepFile read_sweep(const std::filesystem::path& file, const Overrides& overrides,
                     std::optional<std::uint64_t> seed) {
  ConfigFile config(file, overrides);
  TableReader top = config.top();
  require_kind(FileKind::sweep, top, file);
  SweepFile read{.sweep = {}, .inputs = {file}};
  calib::Sweep& sweep = read.sweep;
  read_plan(top, sweep);
  if (!sweep.plan.problems().empty()) {  // no points, so the scene is read as it stands
    sim::Scene scene;
    read_scene_tables(top, scene);
    read_questions(top, sweep);
    config.finish();
  }
  read_questions(top, sweep);
  read.warnings = idle_keys_of_sweep(top, sweep.plan);
  if (seed) sweep.plan.seed = *seed;  // before points are drawn by it
  if (sweep.name.empty()) sweep.name = file.stem().string();

  std::vector<Problem> problems = settings_of_varied_keys(overrides, sweep.plan);
  std::ranges::move(findings_without_comparison(file, sweep), std::back_inserter(problems));
  for (const std::vector<std::string>& values : points_of(sweep.plan)) {
    try {
      sweep.points.push_back(read_point(read, overrides, values));
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems())
        problems.push_back(of_sweep(problem, file, sweep.plan));
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  std::ranges::move(idle_keys_of_the_limit(sweep), std::back_inserter(read.warnings));
  std::ranges::move(doubts_of_all_points(sweep), std::back_inserter(read.warnings));
  return read;
}

}  // namespace havers::io
