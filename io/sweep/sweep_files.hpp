// What a sweep leaves: tidy tables and result.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calib/sweep/sweep.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

/// One row for each run; the keys of the sweep are columns.
std::string runs_csv(const calib::Sweep& sweep, const calib::SweepResult& result);

/// One row for each point and measure: mean, standard deviation, n, standard error.
std::string summary_csv(const calib::Sweep& sweep, const calib::SweepResult& result);

/// The laws alone: the phenomenological model, without fibres.
nlohmann::json laws_json(const calib::SweepResult& result);

/// The object of a sweep in result.json.
nlohmann::json sweep_json(const calib::Sweep& sweep, const calib::SweepResult& result);

}  // namespace havers::io
