// A test file that is only its content.
#pragma once

#include <string>

#include "io/machine/read_test.hpp"
#include "tests/support/machine_files.hpp"

namespace havers::test {

inline io::TestFile read_content(const std::string& content, const io::ReadOptions& options = {}) {
  const TemporaryFile file(content);
  return io::read_test(file.path(), options);
}

}  // namespace havers::test
