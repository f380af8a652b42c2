#include "core/random.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

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

}  // namespace
}  // namespace rockyard::core
