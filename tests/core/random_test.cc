#include "core/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "core/hash.h"

namespace rockyard::core {
namespace {

using Block = std::array<std::uint32_t, 4>;

TEST(PhiloxTest, KnownAnswersOfRandom123) {
  std::ifstream file(ROCKYARD_SOURCE_DIR "/tests/data/philox/philox4x32_10.txt");
  int vectors = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string generator;
    int rounds = 0;
    Block counter{};
    std::array<std::uint32_t, 2> key{};
    Block expected{};
    words >> generator >> std::dec >> rounds >> std::hex;
    for (auto& word : counter) words >> word;
    for (auto& word : key) words >> word;
    for (auto& word : expected) words >> word;
    ASSERT_TRUE(words) << line;
    EXPECT_EQ(Philox4x32(counter, key), expected) << line;
    ++vectors;
  }
  EXPECT_EQ(vectors, 3);
}

TEST(RandomStreamTest, LayoutOfKeyAndCounterIsPinned) {
  const TrialKey key{.seed = 0x1122334455667788ULL, .trial = 42};
  RandomStream stream(key, Purpose::kGyro, 7);
  for (std::uint32_t block = 0; block < 3; ++block) {
    const Block expected = Philox4x32({block, 7, 8, 42}, {0x55667788U, 0x11223344U});
    for (const std::uint32_t word : expected) EXPECT_EQ(stream.NextU32(), word);
  }
}

TEST(RandomStreamTest, EqualNamesGiveEqualNumbers) {
  RandomStream a({5, 6}, Purpose::kSlip, 3);
  RandomStream b({5, 6}, Purpose::kSlip, 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.NextU64(), b.NextU64());
}

TEST(RandomStreamTest, EveryPartOfTheNameMatters) {
  std::set<std::uint64_t> firsts;
  int streams = 0;
  for (const std::uint64_t seed : {1ULL, 2ULL, 1ULL << 32}) {
    for (std::uint32_t trial = 0; trial < 10; ++trial) {
      for (std::uint32_t purpose = 1; purpose <= 18; ++purpose) {
        for (const std::uint32_t substream : {0U, 1U, 2U, 0xffffffffU}) {
          RandomStream stream({seed, trial}, static_cast<Purpose>(purpose), substream);
          firsts.insert(stream.NextU64());
          ++streams;
        }
      }
    }
  }
  EXPECT_EQ(firsts.size(), static_cast<std::size_t>(streams));
}

TEST(RandomStreamTest, UniformStaysInsideTheOpenInterval) {
  RandomStream stream({1, 0}, Purpose::kTest);
  for (int i = 0; i < 100000; ++i) {
    const double u = stream.Uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
  }
  // The extreme cells: half a cell from either end, and exactly representable.
  constexpr double kCell = 0x1.0p-52;
  EXPECT_GT(0.5 * kCell, 0.0);
  EXPECT_LT((0x1.0p52 - 1.0 + 0.5) * kCell, 1.0);
}

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
