// What a study says of a test and its reduction, for a test that is in no study.
#pragma once

#include "calib/experiment/measured_test.hpp"
#include "io/config/read_scene.hpp"
#include "io/machine/read_test.hpp"

namespace havers::io {

/// What `havers import --set` may say; defaults as in a study.
struct ImportSettings {
  ReadOptions columns{.alone = true};                        ///< Of the test.
  ReadOptions gauge_columns{.logger = true, .alone = true};  ///< Of the second logger's file.
  calib::ReductionOptions reduction;
};

/// The keys of a [[specimen]], `columns.force`, `gauge_columns.strain_unit`, `specimen_in_file`,
/// and those of [reduction], `reduction.remove_toe`, each as key=value. @throws InputError with
/// every problem.
ImportSettings read_import_settings(const Overrides& overrides);

}  // namespace havers::io
