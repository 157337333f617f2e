// Which columns sparse rows determine, as they come one by one.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

namespace havers::sim {

/// Rows reduced by those before them: each that is not their combination gets a pivot of its own.
class RowEchelon {
 public:
  using Row = std::vector<std::pair<int, double>>;  ///< Columns with their values.

  /// @param least  Pivots are no smaller. A row that rounding could have made says nothing.
  explicit RowEchelon(double least) : least_(least) {}

  /// @return the column in which the row has its pivot; −1 where it has none, and is forgotten.
  int add(const Row& row);

 private:
  struct Pivot {
    int number;  // in the order in which they were found
    Row rest;    // of the row, divided by its pivot; of none that was found before
  };
  double least_;
  std::unordered_map<int, Pivot> pivots_;  // by column
};

}  // namespace havers::sim
