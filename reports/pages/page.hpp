// What the pages share: filling templates, and the pieces that several of them show.
#pragma once

#include <mstch/mstch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calib/fit/calibration.hpp"
#include "reports/pages.hpp"

namespace havers::reports {

/// Names with values, both as text.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A string for a template; a bare literal would turn into a truth value.
inline mstch::node text(std::string value) {
  return mstch::node{std::move(value)};
}

/// A verdict's grade, which is its colour: bad unless it is sound, mixed unless it is wholly so.
inline mstch::node grade(bool sound, bool wholly = true) {
  return text(!sound ? "bad" : wholly ? "good" : "mixed");
}

/// What `row` makes of each item: the rows of a table, the entries of a list.
template <class Items, class Row>
mstch::array list_of(const Items& items, Row row) {
  mstch::array list;
  for (const auto& item : items) list.emplace_back(row(item));
  return list;
}

/// {name, value} of each.
mstch::array fact_list(const Facts& facts);

/// A list for a section of a template that vanishes with it: {items}, or nothing when it is empty.
mstch::node section(mstch::array items);

/// Sections that several pages have: simplifications with their reasons, checks with their
/// outcomes, sentences, corrections. An empty one vanishes.
mstch::node left_out_section(const std::vector<sim::LeftOut>& left_out);
mstch::node check_section(const std::vector<calib::Check>& checks);
mstch::node text_section(const std::vector<std::string>& sentences);
mstch::node correction_section(const std::vector<calib::Correction>& corrections);

/// "2 of 2 tests can be used", "1 of 2 fits cannot be trusted (A1)": the verdict over several of a
/// noun.
std::string how_many_can(const std::string& verb, const std::string& noun, std::size_t all,
                         const std::vector<std::string>& cannot);

/// Whether a fit may be used, in a sentence; with why not, or how many checks made a reservation.
std::string fit_sentence(const calib::CalibrationResult& result);

/// How the search of a fit ended, and over which specimens.
std::string status_sentence(const calib::CalibrationResult& result);

/// What the search took, its cost and its time together.
std::string search_sentence(const FitReport& report);

/// The numbers of a section below its overlay.
std::string section_caption(const calib::SectionPorosity& section);

/// "12.3 s", "4 min 12 s"; "unrecorded" for what is not finite.
std::string duration(double seconds);

/// An angle in degrees.
std::string degrees(double radians);

/// The file behind the last slash, or the whole when there is none.
std::string base_name(const std::string& path);

/// The foot of a page: where its results come from, and the digests of the files they were made of.
struct Footer {
  Facts facts, digests;  ///< In the order in which they were added.

  /// @param whose  Stands before each name, where a page has several results.
  void add(const calib::Provenance& provenance, const std::string& whose = "");
};

/// A whole page: the template of that name filled, in the common frame.
std::string render_page(const std::string& title, const std::string& name, mstch::map content,
                        const Footer& footer);
/// The same of one result.
std::string render_page(const std::string& title, const std::string& name, mstch::map content,
                        const calib::Provenance& provenance);

}  // namespace havers::reports
