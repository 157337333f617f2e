#include "io/store/sqlite_store.hpp"

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <thread>

#include "tests/io/complaints.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

using calib::Response;
using testing::HasSubstr;

std::string key_of(int i) {
  return "model 1, specimen A1, seed " + std::to_string(i);
}

// A response that says by which number it was made.
Response response_of(int i) {
  Response response;
  response.failed = i % 3 == 0;
  response.broke = i % 2 == 0;
  response.why = "run " + std::to_string(i);
  response.modulus = 13e9 / (1.0 + i);
  response.strength = std::sqrt(2.0) * i;
  response.failure_strain = 1e-3 / (1.0 + i);
  for (int k = 0; k < 200; ++k) {
    response.strain.push_back(1e-5 * k);
    response.stress.push_back(std::sin(i + 0.1 * k));
  }
  return response;
}

void expect_same(const std::optional<Response>& found, const Response& saved) {
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->failed, saved.failed);
  EXPECT_EQ(found->broke, saved.broke);
  EXPECT_EQ(found->why, saved.why);
  EXPECT_EQ(found->modulus, saved.modulus);
  EXPECT_EQ(found->strength, saved.strength);
  EXPECT_EQ(found->failure_strain, saved.failure_strain);
  EXPECT_EQ(found->strain, saved.strain);
  EXPECT_EQ(found->stress, saved.stress);
}

class Store : public testing::Test {
 protected:
  std::string refusal() {
    return test::refusal_of([this] { open_store(file); });
  }
  void run_sql(const char* sql) {
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }
  test::ScratchFolder folder;
  std::filesystem::path file = folder.path() / "evaluations.sqlite";
};

TEST_F(Store, FindsWhatWasSavedAndNothingElse) {
  const auto store = open_store(file);
  EXPECT_FALSE(store->find(key_of(1)).has_value());
  store->save(key_of(1), response_of(1));
  expect_same(store->find(key_of(1)), response_of(1));
  EXPECT_FALSE(store->find(key_of(2)).has_value());
}

TEST_F(Store, KeepsTheLastOfTwoAnswersToOneKey) {
  const auto store = open_store(file);
  store->save(key_of(1), response_of(1));
  store->save(key_of(1), response_of(2));
  expect_same(store->find(key_of(1)), response_of(2));
}

TEST_F(Store, RemembersWhenOpenedAgain) {
  open_store(file)->save(key_of(1), response_of(1));
  expect_same(open_store(file)->find(key_of(1)), response_of(1));
}

TEST_F(Store, KeepsNumbersThatAreNotFiniteAndCurvesThatAreEmpty) {
  const auto store = open_store(file);
  Response response;
  response.modulus = std::numeric_limits<double>::quiet_NaN();
  response.strength = std::numeric_limits<double>::infinity();
  response.failure_strain = -0.0;
  store->save("", response);
  const std::optional<Response> found = store->find("");
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(std::isnan(found->modulus));
  EXPECT_EQ(found->strength, response.strength);
  EXPECT_TRUE(found->strain.empty());
  EXPECT_TRUE(found->stress.empty());
}

TEST_F(Store, CanBeUsedFromSeveralThreads) {
  const auto store = open_store(file);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = t; i < 100; i += 4) {
        store->save(key_of(i), response_of(i));
        expect_same(store->find(key_of(i)), response_of(i));
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 100; ++i) expect_same(store->find(key_of(i)), response_of(i));
}

pid_t in_a_child(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    work();
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

void expect_success(pid_t child) {
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

// Each wants to be the one that makes the file and sets its journal.
TEST_F(Store, IsCreatedByManyProcessesAtOnce) {
  HAVERS_SLOW;
  for (int round = 0; round < 60; ++round) {
    std::vector<pid_t> children;
    for (int i = 0; i < 8; ++i)
      children.push_back(
          in_a_child([&] { open_store(file)->save(key_of(round), response_of(round)); }));
    for (const pid_t child : children) expect_success(child);
    expect_same(open_store(file)->find(key_of(round)), response_of(round));
    std::filesystem::remove(file);
  }
}

// Both create the file, at the same time, and both write all the time.
TEST_F(Store, IsSharedByTwoProcesses) {
  constexpr int many = 200;
  for (int round = 0; round < 5; ++round) {
    const auto save_from = [&](int first) {
      const auto store = open_store(file);
      for (int i = first; i < many; i += 2) store->save(key_of(i), response_of(i));
    };
    const std::array<pid_t, 2> children{in_a_child([&] { save_from(0); }),
                                        in_a_child([&] { save_from(1); })};
    for (const pid_t child : children) expect_success(child);
    const auto store = open_store(file);
    for (int i = 0; i < many; ++i) expect_same(store->find(key_of(i)), response_of(i));
    folder.write("evaluations.sqlite", "");
  }
}

// The child says through a pipe how many rows it has saved and is killed in the middle of its
// writing; every row it has told of must be there, and the file must go on working.
TEST_F(Store, LosesNothingThatWasSavedWhenKilled) {
  for (int told = 1; told <= 64; told *= 4) {
    std::filesystem::remove(file);
    std::array<int, 2> pipe_ends{};
    ASSERT_EQ(pipe(pipe_ends.data()), 0);
    const pid_t child = in_a_child([&] {
      const auto store = open_store(file);
      for (int i = 0;; ++i) {
        store->save(key_of(i), response_of(i));
        if (write(pipe_ends[1], "x", 1) != 1) _exit(1);
      }
    });
    char byte = 0;
    for (int i = 0; i < told; ++i) ASSERT_EQ(::read(pipe_ends[0], &byte, 1), 1);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    close(pipe_ends[0]);
    close(pipe_ends[1]);

    const auto store = open_store(file);
    for (int i = 0; i < told; ++i) expect_same(store->find(key_of(i)), response_of(i));
    store->save("after", response_of(7));
    expect_same(store->find("after"), response_of(7));
  }
}

TEST_F(Store, RefusesWhatIsNotADatabase) {
  folder.write("evaluations.sqlite", std::string(4096, 'x'));
  EXPECT_THAT(
      refusal(),
      HasSubstr("evaluations.sqlite: cannot be used as a store of simulations: file is not a "
                "database (remove it to simulate anew, or name another folder)"));
}

TEST_F(Store, RefusesTheDatabaseOfAnotherProgramAndLeavesItAlone) {
  run_sql("CREATE TABLE addresses (name TEXT)");
  const std::string before = test::contents(file);
  EXPECT_THAT(refusal(),
              HasSubstr("is a database of another program (name another folder, or remove it)"));
  EXPECT_EQ(test::contents(file), before);
}

TEST_F(Store, RefusesAStoreOfANewerFormat) {
  open_store(file);
  run_sql("PRAGMA user_version = 2");
  EXPECT_THAT(
      refusal(),
      HasSubstr("is a store of format 2, this havers reads format 1 (use the havers that wrote "
                "it, or remove it to simulate anew)"));
}

TEST_F(Store, RefusesAPlaceWhereItCannotWrite) {
  file = folder.path() / "none" / "evaluations.sqlite";
  EXPECT_THAT(refusal(),
              HasSubstr("cannot be used as a store of simulations: unable to open database file"));
}

}  // namespace
}  // namespace havers::io
