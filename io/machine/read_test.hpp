// A testing machine's export to channels in SI units.
#pragma once

#include <filesystem>
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
  std::string layout;      ///< Name of the recognised layout, e.g. "Bluehill raw data".
  std::string encoding;    ///< "ASCII", "UTF-8", ...
  std::string delimiter;   ///< "," ";" or "\t".
  std::string decimal;     ///< "." or ",".
  std::vector<Column> columns;
  std::size_t rows = 0;
  calib::RawTest test;
};

/// Reads one export. @throws InputError naming file and line.
TestFile read_test(const std::filesystem::path& file);

/// Writes a test in the Bluehill layout that read_test reads; for `synthesize` and tests.
void write_bluehill(const std::filesystem::path& file, const calib::RawTest& test);

}  // namespace havers::io
