#include "io/store/database.hpp"

#include <sqlite3.h>

#include <cstring>
#include <limits>

#include "io/input_error.hpp"

namespace havers::io {
namespace {

constexpr int patience = 60'000;  // [ms]

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close(handle);
}

Database::Database(const std::filesystem::path& file) : file_(file.string()) {
  sqlite3* handle = nullptr;
  const int code =
      sqlite3_open_v2(file_.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  // Even a failure leaves a handle, which has the message and must be closed.
  handle_.reset(handle);
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(handle, patience);
}

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::insist(const std::string& sql) {
  // Each turn sleeps for a millisecond, so `waited` is in ms.
  for (int waited = 0;; ++waited) {
    const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code == SQLITE_OK) return;
    if (code != SQLITE_BUSY || waited == patience) fail();
    sqlite3_sleep(1);
  }
}

int Database::ask(const std::string& sql) {
  Query query(*this, sql);
  return query.step() ? static_cast<int>(query.number(0)) : 0;
}

void Database::fail() const {
  const int code = sqlite3_errcode(handle_.get());
  // After other failures, as a full disk, the store may be sound: no advice to remove it.
  const bool damaged = code == SQLITE_CORRUPT || code == SQLITE_NOTADB;
  throw InputError(
      file_,
      std::string("cannot be used as a store of simulations: ") + sqlite3_errmsg(handle_.get()),
      damaged ? "remove it to simulate anew, or name another folder" : "");
}

void Query::Finish::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Query::Query(Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(database.handle_.get(), sql.c_str(), -1, &statement, nullptr));
  statement_.reset(statement);
}

void Query::check(int code) const {
  if (code != SQLITE_OK) database_->fail();
}

void Query::bind(int at, bool value) {
  check(sqlite3_bind_int(statement_.get(), at, value ? 1 : 0));
}

void Query::bind(int at, double value) {
  check(sqlite3_bind_double(statement_.get(), at, value));
}

void Query::bind(int at, const std::string& text) {
  // SQLITE_TRANSIENT: SQLite keeps a copy, as the text may be gone before the step.
  check(sqlite3_bind_text64(statement_.get(), at, text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
}

// An empty vector may have no data, which SQLite would take for NULL.
void Query::bind(int at, std::span<const double> numbers) {
  const void* data = numbers.empty() ? "" : static_cast<const void*>(numbers.data());
  check(sqlite3_bind_blob64(statement_.get(), at, data, numbers.size_bytes(), SQLITE_TRANSIENT));
}

bool Query::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_->fail();
  return code == SQLITE_ROW;
}

bool Query::flag(int column) const {
  return sqlite3_column_int(statement_.get(), column) != 0;
}

double Query::number(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL)
    return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_.get(), column);
}

std::string Query::text(int column) const {
  // The text is asked before its length: asking may convert it.
  const void* data = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return {static_cast<const char*>(data), size};
}

std::vector<double> Query::numbers(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  std::vector<double> numbers(size / sizeof(double));
  // Copied, as a blob need not be aligned as doubles are.
  if (!numbers.empty()) std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
  return numbers;
}

void Query::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

}  // namespace havers::io
