#include "io/input_error.hpp"

#include <gtest/gtest.h>

namespace havers::io {
namespace {

TEST(InputError, TellsEachProblemOnceInALineOfItsOwn) {
  const InputError error(
      {{"a.csv", "is empty"}, {"a.csv", "is empty"}, {"b\nc.csv", "is", "it\x1B?"}});
  EXPECT_EQ(error.problems().size(), 2U);
  EXPECT_STREQ(error.what(), "a.csv: is empty\nb c.csv: is (it ?)");
}

}  // namespace
}  // namespace havers::io
