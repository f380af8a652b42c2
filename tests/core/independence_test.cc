// Streams whose names differ in one part are independent: joint cell counts of pairs, chi-square.
#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"
#include "core/statistical_checks.h"

namespace rockyard::core {
namespace {

constexpr double kIndependenceAlpha = 1e-4;
constexpr int kPairs = 100000;
constexpr std::size_t kSide = 16;

template <typename NextPair>
double JointP(NextPair next_pair) {
  std::vector<double> observed(kSide * kSide, 0.0);
  for (int i = 0; i < kPairs; ++i) {
    const auto [a, b] = next_pair(static_cast<std::uint32_t>(i));
    const auto row = static_cast<std::size_t>(a * kSide);
    const auto column = static_cast<std::size_t>(b * kSide);
    observed[row * kSide + column] += 1.0;
  }
  return ChiSquareP(observed, std::vector<double>(kSide * kSide, kPairs / double{kSide * kSide}));
}

double JointOf(RandomStream a, RandomStream b) {
  return JointP([&](std::uint32_t) { return std::pair(a.Uniform(), b.Uniform()); });
}

TEST(IndependenceTest, StreamsThatDifferInOnePartOfTheirName) {
  const RandomStream stream({1, 1}, Purpose::kGyro, 1);
  EXPECT_GT(JointOf(stream, RandomStream({2, 1}, Purpose::kGyro, 1)), kIndependenceAlpha);
  EXPECT_GT(JointOf(stream, RandomStream({1, 2}, Purpose::kGyro, 1)), kIndependenceAlpha);
  EXPECT_GT(JointOf(stream, RandomStream({1, 1}, Purpose::kEncoder, 1)), kIndependenceAlpha);
  EXPECT_GT(JointOf(stream, RandomStream({1, 1}, Purpose::kGyro, 2)), kIndependenceAlpha);
}

TEST(IndependenceTest, NegativeControlAStreamDependsOnItself) {
  const RandomStream stream({1, 1}, Purpose::kGyro, 1);
  EXPECT_LT(JointOf(stream, stream), kIndependenceAlpha);
}

// How noise is used: one short stream per scan.
TEST(IndependenceTest, FirstNumbersOfNeighbouringSubstreams) {
  EXPECT_GT(JointP([](std::uint32_t i) {
              RandomStream a({3, 0}, Purpose::kStripeMissed, 2 * i);
              RandomStream b({3, 0}, Purpose::kStripeMissed, 2 * i + 1);
              return std::pair(a.Uniform(), b.Uniform());
            }),
            kIndependenceAlpha);
}

// Negative control: numbers that grow with the name's number instead of being scrambled by it.
TEST(IndependenceTest, NegativeControlWeylSequence) {
  constexpr double kGoldenRatio = 0.61803398874989485;
  EXPECT_LT(JointP([](std::uint32_t i) {
              const double a = std::fmod(2.0 * i * kGoldenRatio, 1.0);
              const double b = std::fmod((2.0 * i + 1.0) * kGoldenRatio, 1.0);
              return std::pair(a, b);
            }),
            kIndependenceAlpha);
}

TEST(IndependenceTest, FirstNumbersOfNeighbouringTrials) {
  EXPECT_GT(JointP([](std::uint32_t i) {
              RandomStream a({3, 2 * i}, Purpose::kRockCount);
              RandomStream b({3, 2 * i + 1}, Purpose::kRockCount);
              return std::pair(a.Uniform(), b.Uniform());
            }),
            kIndependenceAlpha);
}

TEST(IndependenceTest, ConsecutiveNumbersOfOneStream) {
  RandomStream stream({4, 0}, Purpose::kTest);
  EXPECT_GT(JointP([&](std::uint32_t) {
              const double first = stream.Uniform();
              return std::pair(first, stream.Uniform());
            }),
            kIndependenceAlpha);
}

}  // namespace
}  // namespace rockyard::core
