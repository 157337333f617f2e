#include "io/machine/encoding.hpp"

#include <gtest/gtest.h>

namespace havers::io {
namespace {

TEST(Encoding, IsUtf8WhereEveryCharacterIs) {
  for (const char* text : {"caf\xC3\xA9;1.0\n", "10 \xE2\x84\xA6\n", "\xF0\x9F\xA6\xB4;1\n"})
    EXPECT_EQ(find_encoding(text).name, "UTF-8") << text;
  // Cut off by the end of the block.
  for (const char* text : {"caf\xC3", "10 \xE2\x84", "\xF0\x9F\xA6"})
    EXPECT_EQ(find_encoding(text).name, "UTF-8") << text;
}

// What continues nothing, is continued by nothing, is longer than it need be, or half a pair.
TEST(Encoding, IsNotUtf8WhereACharacterIsNone) {
  for (const char* text :
       {"a\xA9;1\n", "caf\xC3;1\n", "a\xC0\xAF;1\n", "\xED\xA0\x80;1\n", "\xF5\x80\x80\x80\n"})
    EXPECT_NE(find_encoding(text).name, "UTF-8") << text;
}

}  // namespace
}  // namespace havers::io
