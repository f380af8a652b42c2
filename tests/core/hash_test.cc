#include "core/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>

namespace rockyard::core {
namespace {

std::uint64_t OfText(std::string_view text) { return Hasher().RawText(text).value(); }

// Test values of the authors (Fowler, Noll, Vo; Eastlake et al., "The FNV Non-Cryptographic Hash
// Algorithm", appendix C).
TEST(HashTest, KnownAnswersOfFnv1a64) {
  EXPECT_EQ(OfText(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(OfText("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(OfText("foobar"), 0x85944171f73967e8ULL);
}

TEST(HashTest, NumbersEnterAsLittleEndianBytes) {
  constexpr std::array<std::byte, 8> kBytes = {std::byte{8}, std::byte{7}, std::byte{6},
                                               std::byte{5}, std::byte{4}, std::byte{3},
                                               std::byte{2}, std::byte{1}};
  EXPECT_EQ(Hasher().Integer(0x0102030405060708ULL).value(), Hasher().Bytes(kBytes).value());
  EXPECT_EQ(Hasher().Real(1.5).value(), Hasher().Integer(0x3ff8000000000000ULL).value());
}

TEST(HashTest, TextBoundariesCount) {
  EXPECT_NE(Hasher().Text("ab").Text("c").value(), Hasher().Text("a").Text("bc").value());
}

TEST(HashTest, SignedZerosDifferAndNansAgree) {
  EXPECT_NE(Hasher().Real(0.0).value(), Hasher().Real(-0.0).value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double other_nan = std::bit_cast<double>(std::bit_cast<std::uint64_t>(nan) | 1U);
  EXPECT_EQ(Hasher().Real(nan).value(), Hasher().Real(-nan).value());
  EXPECT_EQ(Hasher().Real(nan).value(), Hasher().Real(other_nan).value());
}

TEST(HashTest, EveryBitOfADoubleCounts) {
  const std::uint64_t before = Hasher().Real(1.0).value();
  for (int bit = 0; bit < 64; ++bit) {
    const auto bits = std::bit_cast<std::uint64_t>(1.0) ^ (std::uint64_t{1} << bit);
    EXPECT_NE(Hasher().Real(std::bit_cast<double>(bits)).value(), before) << bit;
  }
}

TEST(HashTest, HexHasSixteenDigits) {
  EXPECT_EQ(Hex(0), "0000000000000000");
  EXPECT_EQ(Hex(0xAF63DC4C8601EC8CULL), "af63dc4c8601ec8c");
}

}  // namespace
}  // namespace rockyard::core
