#include "io/results/sha256.hpp"

#include <gtest/gtest.h>

#include "io/input_error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace havers::io {
namespace {

// Examples of FIPS 180-4 as published by NIST.
TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_text("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of_text(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const test::ScratchFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(sha256(folder.write("file", bytes)), sha256_of_text(bytes));
}

TEST(Sha256, SaysWhyAFileCannotBeRead) {
  const test::ScratchFolder folder;
  EXPECT_THROW(sha256(folder.path() / "none"), InputError);
  EXPECT_THROW(sha256(folder.path()), InputError);
}

}  // namespace
}  // namespace havers::io
