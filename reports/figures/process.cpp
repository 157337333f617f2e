// By posix_spawn without a shell, so that no argument has to be quoted.
#include "reports/figures/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

namespace havers::reports {
namespace {

namespace fs = std::filesystem;

// A folder of its own for the program's three streams. Files instead of pipes: nothing can block or
// break.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code none;  // TMPDIR may name what is not there
    std::string name = (fs::temp_directory_path(none) / "havers-XXXXXX").string();
    if (!none && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  [[nodiscard]] std::string file(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

// A process group of its own: Ctrl-C in a terminal is meant for havers, not for what draws.
class OwnGroup {
 public:
  OwnGroup() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~OwnGroup() { posix_spawnattr_destroy(&attributes_); }
  OwnGroup(const OwnGroup&) = delete;
  OwnGroup& operator=(const OwnGroup&) = delete;
  OwnGroup(OwnGroup&&) = delete;
  OwnGroup& operator=(OwnGroup&&) = delete;

  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

// The exit status of a process, which is ended where it takes too long; -1 where it has none.
int status_of(pid_t pid) {
  using namespace std::chrono_literals;
  constexpr auto patience = 120s;
  const auto begin = std::chrono::steady_clock::now();
  for (int status = 0;;) {
    const pid_t ended = waitpid(pid, &status, WNOHANG);
    if (ended != 0) return ended == pid && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    // Kills the whole process group, with whatever the program has started.
    if (std::chrono::steady_clock::now() - begin > patience) kill(-pid, SIGKILL);
    std::this_thread::sleep_for(1ms);
  }
}

std::string read_all(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

ProcessResult run_process(std::vector<std::string> command, const std::string& input) {
  ProcessResult result;
  const TemporaryFolder folder;
  if (!folder.exists()) return result;
  const std::string in = folder.file("in"), out = folder.file("out"), err = folder.file("err");
  std::ofstream written(in, std::ios::binary);
  written << input;
  written.close();
  if (!written) return result;  // as on a disk that is full

  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  constexpr int write = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), write, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), write, 0600);

  // As exec demands: not constant, and a null pointer behind the last one.
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const OwnGroup group;
  result.started = posix_spawnp(&pid, arguments.front(), &actions, group.attributes(),
                                arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  if (!result.started) return result;

  result.status = status_of(pid);
  result.output = read_all(out);
  result.errors = read_all(err);
  return result;
}

}  // namespace havers::reports
