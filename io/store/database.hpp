// The little of SQLite that a store needs: a file and prepared statements.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace havers::io {

/// An open file. Every failure is an InputError that names the file. A Query points to its
/// Database, which must neither move nor end before it.
class Database {
 public:
  /// Opens or creates the file. Waits up to a minute for other processes' transactions.
  explicit Database(const std::filesystem::path& file);

  /// Runs statements that answer nothing.
  void run(const std::string& sql);
  /// The same again as long as the file is busy, a minute at most, for what SQLite does not wait
  /// with itself.
  void insist(const std::string& sql);
  /// The whole number that a statement answers; 0 where it has no row.
  int ask(const std::string& sql);

  /// Throws what SQLite says of its last failure.
  [[noreturn]] void fail() const;

 private:
  friend class Query;
  /// Closing rolls back what was not committed.
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string file_;  ///< For messages.
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A statement, prepared once. Bind ?1, ?2... in turn from 1, step, read columns from 0, reset.
class Query {
 public:
  Query(Database& database, const std::string& sql);

  void bind(int at, bool value);
  void bind(int at, double value);  ///< NaN becomes NULL.
  void bind(int at, const std::string& text);
  void bind(int at,
            std::span<const double> numbers);  ///< As a blob, in the byte order of the machine.

  bool step();  ///< Whether there is a row.
  [[nodiscard]] bool flag(int column) const;
  [[nodiscard]] double number(int column) const;  ///< NULL is NaN.
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::vector<double> numbers(int column) const;

  /// Ready for the next use; what was bound is forgotten.
  void reset();

 private:
  struct Finish {
    void operator()(sqlite3_stmt* statement) const;
  };
  /// Throws unless the code is SQLITE_OK.
  void check(int code) const;

  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finish> statement_;
};

}  // namespace havers::io
