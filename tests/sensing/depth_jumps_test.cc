#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sensing/stereo_depth.h"

namespace rockyard::sensing {
namespace {

std::vector<int> Distances(const std::vector<double>& row_px, double jump_px = 1.0) {
  std::vector<int> distances(row_px.size());
  JumpDistances(row_px, jump_px, distances);
  return distances;
}

TEST(DepthJumpsTest, CountsColumnsFromBothSidesOfAJump) {
  EXPECT_EQ(Distances({5, 5, 5, 8, 8, 8, 8}), (std::vector<int>{3, 2, 1, 1, 2, 3, 4}));
  EXPECT_EQ(Distances({5, 5, 4, 4, 4, 5}), (std::vector<int>{2, 1, 1, 2, 1, 1}));
}

TEST(DepthJumpsTest, ARowWithoutAJumpIsFarFromOne) {
  for (const int distance : Distances({5, 5.5, 6.4, 7.3, 8.2})) EXPECT_GE(distance, kNoJump);
  EXPECT_GE(Distances({5}).front(), kNoJump);
  EXPECT_TRUE(Distances({}).empty());
}

TEST(DepthJumpsTest, AJumpIsExactlyAsLargeOrLarger) {
  EXPECT_EQ(Distances({5, 6})[0], 1);
  EXPECT_GE(Distances({5, 6}, 1.001)[0], kNoJump);
}

// Against the definition: the nearest of all jumps, looked for from every pixel.
TEST(DepthJumpsTest, IsTheNearestOfAllJumps) {
  std::vector<double> row_px;
  for (int i = 0; i < 60; ++i) row_px.push_back((i * i * 7 % 31) / 8.0);
  const std::vector<int> found = Distances(row_px);
  for (int i = 0; i < 60; ++i) {
    int nearest = kNoJump;
    for (int c = 1; c < 60; ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (std::abs(row_px[at] - row_px[at - 1]) < 1.0) continue;
      nearest = std::min(nearest, i >= c ? i - c + 1 : c - i);
    }
    EXPECT_EQ(std::min(found[static_cast<std::size_t>(i)], kNoJump), nearest) << i;
  }
}

// The other side of a jump begins where its distance says, on either hand.
TEST(DepthJumpsTest, FindsTheOtherSide) {
  const std::vector<double> row_px{5, 5, 5, 8, 8, 8, 3};
  const std::vector<int> distances = Distances(row_px);
  const std::vector<std::size_t> across{3, 3, 3, 2, 6, 6, 5};
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    EXPECT_EQ(AcrossJump(row_px, 1.0, column, distances[column]), across[column]) << column;
  }
}

}  // namespace
}  // namespace rockyard::sensing
