#include "io/config/read_import.hpp"

#include "io/config/study_keys.hpp"
#include "io/config/table_reader.hpp"

namespace havers::io {

ImportSettings read_import_settings(const Overrides& overrides) {
  // Reads keys of a study without a file: complaints name "--set KEY" instead of a line.
  ConfigFile no_file({}, overrides);
  TableReader top = no_file.top();
  TableReader columns = top.table("columns"), gauge_columns = top.table("gauge_columns");
  ImportSettings settings;
  specimen_in_file(top, settings.columns);
  keys(columns, settings.columns);
  keys(gauge_columns, settings.gauge_columns);
  read_reduction(top.table("reduction"), settings.reduction);
  no_file.finish();
  return settings;
}

}  // namespace havers::io
