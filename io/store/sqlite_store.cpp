#include "io/store/sqlite_store.hpp"

#include <fmt/format.h>

#include <cassert>
#include <mutex>
#include <optional>

#include "io/input_error.hpp"
#include "io/results/sha256.hpp"
#include "io/store/database.hpp"

namespace havers::io {
namespace {

constexpr int application = 0x48415652;  // "HAVR" in the file's header marks it as ours
constexpr int format = 1;                // of the table below

// id is the SHA-256 of the key; curve holds all strains, then all stresses.
constexpr const char* create_table =
    "CREATE TABLE evaluations (id TEXT PRIMARY KEY, key TEXT NOT NULL,"
    " failed INTEGER NOT NULL, broke INTEGER NOT NULL, why TEXT NOT NULL,"
    " modulus_Pa REAL, strength_Pa REAL, failure_strain REAL, curve BLOB NOT NULL)";

// Inside one transaction, so that of two processes that create a file one waits for the other.
void create_or_recognise(Database& database, const std::string& file) {
  database.run("BEGIN IMMEDIATE");
  const int owner = database.ask("PRAGMA application_id");
  const int version = database.ask("PRAGMA user_version");
  const bool empty = database.ask("SELECT count(*) FROM sqlite_master") == 0;
  // An empty file becomes a store; any other must be one already. After a throw the transaction is
  // rolled back as the file is closed, and leaves it as it was.
  if (empty && owner == 0) {
    database.run(create_table);
    database.run(fmt::format("PRAGMA application_id = {}", application));
    database.run(fmt::format("PRAGMA user_version = {}", format));
  } else if (owner != application) {
    throw InputError(file, "is a database of another program", "name another folder, or remove it");
  } else if (version != format) {
    throw InputError(
        file, fmt::format("is a store of format {}, this havers reads format {}", version, format),
        "use the havers that wrote it, or remove it to simulate anew");
  }
  database.run("COMMIT");
}

Database open_database(const std::filesystem::path& file) {
  Database database(file);
  create_or_recognise(database, file.string());
  // With a write-ahead log readers do not wait for writers, and a commit needs no flush to survive
  // a kill.
  database.insist("PRAGMA journal_mode = WAL");
  database.run("PRAGMA synchronous = NORMAL");
  return database;
}

// A statement in use, made ready for the next one however the use ends.
class InUse {
 public:
  explicit InUse(Query& query) : query_(query) {}
  ~InUse() { query_.reset(); }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;
  Query* operator->() { return &query_; }

 private:
  Query& query_;
};

class SqliteStore : public calib::EvaluationStore {
 public:
  explicit SqliteStore(const std::filesystem::path& file)
      : database_(open_database(file)),
        select_(database_,
                "SELECT failed, broke, why, modulus_Pa, strength_Pa, failure_strain, curve"
                " FROM evaluations WHERE id = ?1"),
        insert_(database_,
                "INSERT OR REPLACE INTO evaluations VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)") {}

  std::optional<calib::Response> find(const std::string& key) override {
    const std::scoped_lock lock(mutex_);
    InUse row(select_);
    row->bind(1, sha256_of_text(key));
    if (!row->step()) return std::nullopt;
    const std::vector<double> curve = row->numbers(6);
    const auto half = curve.begin() + static_cast<std::ptrdiff_t>(curve.size() / 2);
    return calib::Response{.failed = row->flag(0),
                           .broke = row->flag(1),
                           .why = row->text(2),
                           .modulus = row->number(3),
                           .strength = row->number(4),
                           .failure_strain = row->number(5),
                           .strain = {curve.begin(), half},
                           .stress = {half, curve.end()}};
  }

  void save(const std::string& key, const calib::Response& response) override {
    assert(response.strain.size() == response.stress.size());
    std::vector<double> curve = response.strain;
    curve.insert(curve.end(), response.stress.begin(), response.stress.end());

    const std::scoped_lock lock(mutex_);
    InUse row(insert_);
    row->bind(1, sha256_of_text(key));
    row->bind(2, key);
    row->bind(3, response.failed);
    row->bind(4, response.broke);
    row->bind(5, response.why);
    row->bind(6, response.modulus);
    row->bind(7, response.strength);
    row->bind(8, response.failure_strain);
    row->bind(9, std::span<const double>(curve));
    row->step();
  }

 private:
  std::mutex mutex_;   // one connection, many threads
  Database database_;  // declared before its statements, so that it is closed after they end
  Query select_, insert_;
};

}  // namespace

std::unique_ptr<calib::EvaluationStore> open_store(const std::filesystem::path& file) {
  return std::make_unique<SqliteStore>(file);
}

}  // namespace havers::io
