// The keys and words of sweep files and of their results, declared once as in io/config. Laws,
// findings and figures are read from the file; of the results only laws are read back. Equations
// (W1)... are those of calib/sweep/README.md.
#pragma once

#include "calib/sweep/sweep.hpp"
#include "io/config/words.hpp"

namespace havers::io {

/// sweep.sample
template <>
inline constexpr Words<4> words<calib::Sampling>{"list", "grid", "latin-hypercube", "sobol"};
/// response; `name_of` makes columns and keys of results from these words.
template <>
inline constexpr Words<9> words<calib::Measure>{
    "strength",         "failure_strain", "modulus",    "linear_part", "fall_part",
    "head_tail_broken", "flank_broken",   "crack_span", "crack_linked"};
/// finding.test
template <>
inline constexpr Words<8> words<calib::FindingTest>{"same",   "matters", "rises", "falls",
                                                    "linear", "steady",  "above", "below"};
/// `outcome` of a finding in result.json.
template <>
inline constexpr Words<3> words<calib::FindingOutcome>{"agrees", "disagrees", "undecided"};
/// `status` of a law in result.json and laws.json.
template <>
inline constexpr Words<4> words<calib::LawStatus>{"fitted", "too_few_runs", "terms_do_not_vary",
                                                  "unbroken_runs"};

/// The measure's name in result files, with its unit as a suffix where it has one: "strength_Pa".
std::string name_of(calib::Measure measure);

/// [[law]]: least squares over the runs (W1).
template <class Table>
void keys(Table& table, calib::LawRequest& law) {
  table.key("response", law.response);
  table.key("terms", law.terms);  // keys of [sweep.keys]
  table.key("per", law.per);      // empty: one law
}

/// [[finding]]: a claim and how it is to be judged, (W3) to (W5).
template <class Table>
void keys(Table& table, calib::FindingRequest& finding) {
  table.key("id", finding.id);
  table.key("claim", finding.claim);
  table.key("test", finding.test);
  table.key("response", finding.response);
  table.key("keys", finding.keys);  // those compared
  table.key("per", finding.per);
  table.key("margin", finding.margin);  // relative, or in SI units of a mean
  table.key("if_agrees", finding.if_agrees);
  table.key("if_disagrees", finding.if_disagrees);
  table.key("if_undecided", finding.if_undecided);
}

/// [[figure]] of the page.
template <class Table>
void keys(Table& table, calib::SweepFigure& figure) {
  table.key("caption", figure.caption);
  table.key("x", figure.x);            // empty: stress against strain
  table.key("series", figure.series);  // a line for each value
  table.key("per", figure.per);        // a panel for each value
  table.key("response", figure.response);
}

/// A law as fitted, for one value of `per`; in SI units. `read_laws` reads it back.
template <class Table>
void keys(Table& table, calib::Law& law) {
  table.key("response", law.request.response);
  table.key("per", law.request.per);
  table.key("at", law.at);  // its value for this law
  table.key("status", law.status);
  table.key("terms", law.request.terms);
  table.key("coefficients", law.coefficients);  // of the terms, then the constant
  table.key("standard_errors", law.standard_errors);
  table.key("confidence_factor_95", law.confidence_factor);  // half an interval over standard error
  table.key("residual_sd", law.residual_sd);                 // of the runs around the law
  table.key("r_squared", law.explained);
  table.key("runs", law.runs);
  table.key("lack_of_fit_F", law.lack_of_fit);  // (W2)
  table.key("lack_of_fit_p", law.lack_of_fit_p);
}

/// A claim as judged. `value`, `low` and `high` are those of the comparison that speaks most
/// against the claim, and NaN where nothing could be compared.
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
  table.key("ground", finding.ground);            // what was asked, in words
  table.key("meaning", finding.meaning);          // if_agrees, if_disagrees or if_undecided
  table.key("comparisons", finding.comparisons);  // whose intervals hold together
  table.key("runs", finding.runs);
  table.key("inertia_low", finding.inertia_low);  // I (M12) of its points
  table.key("inertia_high", finding.inertia_high);
}

/// The distribution of strength over the seeds of a point (W6).
template <class Table>
void keys(Table& table, calib::StrengthLaw& law) {
  table.key("runs", law.runs);
  table.key("weibull_modulus", law.weibull_modulus);
  table.key("weibull_modulus_95", law.weibull_modulus_95);  // (F23)
  table.key("weibull_scale_Pa", law.weibull_scale);
  table.key("gumbel_location_Pa", law.gumbel_location);
  table.key("gumbel_width_Pa", law.gumbel_width);
  table.key("log_likelihood_gain", law.log_likelihood_gain);  // of Gumbel over Weibull
}

}  // namespace havers::io
