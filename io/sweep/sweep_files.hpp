// What a sweep leaves: tidy tables and result.json.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calib/study/study.hpp"
#include "calib/sweep/sweep.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

/// One row for each run. The keys of the sweep are columns, with values as the file writes them; a
/// measure that no run tells has no column. `point` is the place of the run's point among those of
/// result.json, from 0.
std::string runs_csv(const calib::Sweep& sweep, const calib::SweepResult& result);

/// One row for each point and measure: mean, standard deviation, n, standard error. Where no run of
/// the point tells the measure there is no row.
std::string summary_csv(const calib::Sweep& sweep, const calib::SweepResult& result);

/// The laws alone: the phenomenological model, without fibres.
nlohmann::json laws_json(const calib::SweepResult& result);

/// The laws of strength in such a file that a specimen can be put into.
/// @throws InputError when the file is no such file or has none.
std::vector<calib::SweepLaw> read_laws(const std::filesystem::path& file);

/// The object of a sweep in result.json.
nlohmann::json sweep_json(const calib::Sweep& sweep, const calib::SweepResult& result);

}  // namespace havers::io
