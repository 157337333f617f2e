// What numbers on the command line must be, in the words of input files.
#pragma once

#include <CLI/CLI.hpp>

namespace havers::cli {

/// A finite number above 0.
CLI::Validator above_zero();

/// A finite number, 0 or more.
CLI::Validator not_negative();

/// A whole number from 1 to `most`.
CLI::Validator count(int most);

/// A whole number, 0 or more.
CLI::Validator seed_number();

}  // namespace havers::cli
