#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

#include "web/gunzip.h"
#include "web/page.h"

namespace rockyard::web {
namespace {

TEST(Gzip, ComesBackWhole) {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += std::to_string(i * 7919 % 10'007) + ",";
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(3, '\0'), text}) {
    EXPECT_EQ(test::Gunzip(Gzip(bytes)), bytes);
  }
}

TEST(Gzip, MakesRepetitionSmall) { EXPECT_LT(Gzip(std::string(1'000'000, 'x')).size(), 2'000U); }

// RFC 1952: bytes 4 to 7 are the time, which would make equal pages differ.
TEST(Gzip, HoldsNoTime) {
  const std::string bytes = Gzip("rock");
  EXPECT_EQ(bytes.substr(0, 3), "\x1f\x8b\x08");
  EXPECT_EQ(bytes.substr(4, 4), std::string(4, '\0'));
  EXPECT_EQ(bytes, Gzip("rock"));
}

TEST(Gunzip, RefusesDamage) {
  std::string bytes = Gzip("rock, rock, rock, and sand");
  bytes[bytes.size() - 6] ^= 1;  // in the checksum
  EXPECT_THROW(test::Gunzip(bytes), std::runtime_error);
}

}  // namespace
}  // namespace rockyard::web
