// The keys and words of sweep files and of their results, declared once as in io/config.
#pragma once

#include "calib/sweep/sweep.hpp"
#include "io/config/words.hpp"

namespace havers::io {

template <>
inline constexpr Words<4> words<calib::Sampling>{"list", "grid", "latin-hypercube", "sobol"};
template <>
inline constexpr Words<9> words<calib::Measure>{
    "strength",         "failure_strain", "modulus",    "linear_part", "fall_part",
    "head_tail_broken", "flank_broken",   "crack_span", "crack_linked"};
template <>
inline constexpr Words<8> words<calib::FindingTest>{"same",   "matters", "rises", "falls",
                                                    "linear", "steady",  "above", "below"};
template <>
inline constexpr Words<3> words<calib::FindingOutcome>{"agrees", "disagrees", "undecided"};
template <>
inline constexpr Words<4> words<calib::LawStatus>{"fitted", "too_few_runs", "terms_do_not_vary",
                                                  "unbroken_runs"};

/// The measure's unit in result files, as a suffix: "strength_Pa".
std::string name_of(calib::Measure measure);

template <class Table>
void keys(Table& table, calib::LawRequest& law) {
  table.key("response", law.response);
  table.key("terms", law.terms);
  table.key("per", law.per);
}

template <class Table>
void keys(Table& table, calib::FindingRequest& finding) {
  table.key("id", finding.id);
  table.key("claim", finding.claim);
  table.key("test", finding.test);
  table.key("response", finding.response);
  table.key("keys", finding.keys);
  table.key("per", finding.per);
  table.key("margin", finding.margin);
  table.key("if_agrees", finding.if_agrees);
  table.key("if_disagrees", finding.if_disagrees);
  table.key("if_undecided", finding.if_undecided);
}

template <class Table>
void keys(Table& table, calib::SweepFigure& figure) {
  table.key("caption", figure.caption);
  table.key("x", figure.x);
  table.key("series", figure.series);
  table.key("per", figure.per);
  table.key("response", figure.response);
}

template <class Table>
void keys(Table& table, calib::Law& law) {
  table.key("response", law.request.response);
  table.key("per", law.request.per);
  table.key("at", law.at);
  table.key("status", law.status);
  table.key("terms", law.request.terms);
  table.key("coefficients", law.coefficients);
  table.key("standard_errors", law.standard_errors);
  table.key("confidence_factor_95", law.confidence_factor);
  table.key("residual_sd", law.residual_sd);
  table.key("r_squared", law.explained);
  table.key("runs", law.runs);
  table.key("lack_of_fit_F", law.lack_of_fit);
  table.key("lack_of_fit_p", law.lack_of_fit_p);
}

template <class Table>
void keys(Table& table, calib::Finding& finding) {
  table.key("id", finding.id);
  table.key("claim", finding.claim);
  table.key("per", finding.per);
  table.key("at", finding.at);
  table.key("test", finding.test);
  table.key("response", finding.response);
  table.key("outcome", finding.outcome);
  table.key("value", finding.value);
  table.key("low", finding.low);
  table.key("high", finding.high);
  std::string what = to_string(finding.compared);
  table.key("what", what);
  table.key("ground", finding.ground);
  table.key("meaning", finding.meaning);
  table.key("comparisons", finding.comparisons);
  table.key("runs", finding.runs);
  table.key("inertia_low", finding.inertia_low);
  table.key("inertia_high", finding.inertia_high);
}

template <class Table>
void keys(Table& table, calib::StrengthLaw& law) {
  table.key("runs", law.runs);
  table.key("weibull_modulus", law.weibull_modulus);
  table.key("weibull_modulus_95", law.weibull_modulus_95);
  table.key("weibull_scale_Pa", law.weibull_scale);
  table.key("gumbel_location_Pa", law.gumbel_location);
  table.key("gumbel_width_Pa", law.gumbel_width);
  table.key("log_likelihood_gain", law.log_likelihood_gain);
}

}  // namespace havers::io
