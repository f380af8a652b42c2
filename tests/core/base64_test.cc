#include "core/base64.h"

#include <gtest/gtest.h>

#include <string>

namespace rockyard::core {
namespace {

// RFC 4648, section 10.
TEST(Base64, KnownAnswers) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, BytesBeyondAsciiAndZeros) {
  EXPECT_EQ(Base64(std::string("\x00\xff\x10", 3)), "AP8Q");
  EXPECT_EQ(Base64("\xfb\xef\xbe"), "++++");
  EXPECT_EQ(Base64("\xff\xff\xff"), "////");
}

}  // namespace
}  // namespace rockyard::core
