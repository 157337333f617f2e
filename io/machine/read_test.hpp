// A testing machine's export to channels in SI units.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::io {

/// What a column holds. `volts` of a gauge and `load_volts` of a load cell still lack their factor.
enum class Quantity { time, force, extension, strain, stress, volts, load_volts, other };
std::string to_string(Quantity quantity);

/// A column of the file, read or not.
struct Column {
  std::string name, unit;  ///< As in the file.
  Quantity quantity = Quantity::other;
};

/// A test file as read.
struct TestFile {
  std::string file;
  std::string layout;     ///< Name of the recognised layout, e.g. "Bluehill raw data".
  std::string encoding;   ///< "ASCII", "UTF-8", ...
  std::string delimiter;  ///< "," ";" or "\t".
  std::string decimal;    ///< "." or ",".
  std::vector<Column> columns;
  std::size_t rows = 0;       ///< Of numbers, of this specimen.
  std::size_t number = 1;     ///< Of the specimen in the file, from 1.
  std::size_t specimens = 1;  ///< In the file.
  calib::RawTest test;        ///< What was read, in SI units, with the warnings.
};

/// A column by its name in the file or its number from 1, and its unit where the file's is missing
/// or wrong. A signal in volts takes its factor as unit: "500 N/V".
struct ColumnHint {
  std::string column, unit;
};

/// What the user knows better than the file. The keys are quantities; those without a hint are
/// found by name, by unit and by content, in that order.
struct ReadOptions {
  std::map<Quantity, ColumnHint> columns{};
  std::map<Quantity, std::string> units{};  ///< Of columns without a hint, found by their names.
  std::string specimen{};  ///< Its name in a file of several; its number where it has no name.
  std::optional<int> specimen_number{};  ///< Or its number, from 1.
  bool logger = false;      ///< The file of a second logger: time and a gauge, no force.
  bool has_logger = false;  ///< A second logger's file tells what a volt of the load is.
  bool alone = false;       ///< In no study: what is said of columns is said by --set.
  std::optional<double> width{}, thickness{}, gauge_length{};  ///< Instead of the file's. [m]
};

/// Reads one export, whatever its encoding, delimiter and decimal mark; io/machine/README.md says
/// what is recognised and how. @throws InputError naming file and line, also where the file holds
/// several specimens and `options` names none.
TestFile read_test(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads every specimen of an export, whether they are stacked or side by side; the one of
/// `options.specimen` or its number alone where that is given. @throws InputError naming file and
/// line.
std::vector<TestFile> read_tests(const std::filesystem::path& file,
                                 const ReadOptions& options = {});

/// Writes a test in the Bluehill layout that read_test reads; for `synthesize` and tests. Five
/// decimals of s, mm, N and % of strain, four of MPa: strain is kept to 1e-7. @throws InputError
/// when it cannot be written.
void write_bluehill(const std::filesystem::path& file, const calib::RawTest& test);

}  // namespace havers::io
