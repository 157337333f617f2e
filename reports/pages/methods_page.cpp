// Ways to measure porosity side by side, over all sections and by hardship.
#include <fmt/format.h>

#include "calib/count.hpp"
#include "reports/bench_pages.hpp"
#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

std::string points(double share) {
  return number(share / in::percent, 2);
}

mstch::map method_row(const calib::MethodSummary& method) {
  return {{"method", text(to_string(method.method))},
          {"median", text(points(method.median_error))},
          {"worst", text(points(method.worst_error))},
          {"none", text(points(method.worst_if_none))},
          {"speed", text(number(1e-6 / method.cpu_per_pixel, 3))}};
}

mstch::map hardship_row(const calib::HardshipSummary& hardship) {
  const auto cell = [](const calib::MethodSummary& method) {
    return mstch::map{{"worst", text(points(method.worst_error))}};
  };
  return {{"hardship", text(hardship.hardship)}, {"cells", list_of(hardship.methods, cell)}};
}

}  // namespace

std::string methods_page(const calib::MethodComparison& comparison,
                         const calib::Provenance& provenance) {
  const calib::MethodSummary& ours = comparison.methods.back();
  const bool complete = comparison.complete;
  return render_page(
      "havers bench: porosity of sections", "methods",
      {{"grade", grade(comparison.good(), complete)},
       {"sentence", text(fmt::format("{}On {} {} errs by {} points of porosity at most.",
                                     complete ? "" : "Stopped before all sections were measured. ",
                                     calib::count(comparison.trials.size(), "drawn section"),
                                     to_string(ours.method), points(ours.worst_error)))},
       {"detail", text("Asked: at most 0.3 points, and 0.05 where there are no pores.")},
       {"figure", text(draw(methods_figure(comparison, "methods")))},
       {"methods", list_of(comparison.methods, method_row)},
       {"hardships", list_of(comparison.hardships, hardship_row)}},
      provenance);
}

}  // namespace havers::reports
