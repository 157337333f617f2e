#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/input_error.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

void write_file(const std::filesystem::path& file, const std::string& content) {
  // The process's number keeps two runs on one folder from sharing the temporary.
  const std::filesystem::path temporary = fmt::format("{}.{}.tmp", file.string(), getpid());
  std::ofstream stream(temporary, std::ios::binary);
  stream << content;
  // A full disk may show only when the rest is flushed.
  stream.close();
  std::error_code failure;
  if (stream) std::filesystem::rename(temporary, file, failure);
  if (stream && !failure) return;

  const std::string reason = failure ? failure.message() : std::strerror(errno);
  // After the reason is taken, as this may set another.
  std::filesystem::remove(temporary, failure);
  throw InputError(file.string(), "cannot be written: " + reason);
}

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace havers::io
