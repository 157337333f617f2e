// A testing machine's export to channels in SI units.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::io {

/// What a column holds.
enum class Quantity { time, force, extension, strain, stress, other };
std::string to_string(Quantity quantity);

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
  std::size_t rows = 0;
  calib::RawTest test;
};

/// A column by its name in the file or its number from 1, and its unit where the file's is missing
/// or wrong.
struct ColumnHint {
  std::string column, unit;
};

/// What the user knows better than the file. The keys are quantities; those without a hint are
/// found by name, by unit and by content, in that order.
struct ReadOptions {
  std::map<Quantity, ColumnHint> columns;
};

/// Reads one export, whatever its encoding, delimiter and decimal mark; io/machine/README.md says
/// what is recognised and how. @throws InputError naming file and line.
TestFile read_test(const std::filesystem::path& file, const ReadOptions& options = {});

/// Writes a test in the Bluehill layout that read_test reads; for `synthesize` and tests. Five
/// decimals of s, mm, N and % of strain, four of MPa: strain is kept to 1e-7. @throws InputError
/// when it cannot be written.
void write_bluehill(const std::filesystem::path& file, const calib::RawTest& test);

}  // namespace havers::io
