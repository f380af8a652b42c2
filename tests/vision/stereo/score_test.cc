#include "vision/stereo/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rockyard::vision {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::int16_t Found(double disparity_px) {
  return static_cast<std::int16_t>(std::lround(disparity_px * kDisparityOne));
}

// Five known pixels, of which four have a disparity, off by 0, 0.5, -1.5 and 4.5 px.
TEST(StereoScore, CountsWhatIsBadAmongWhatIsKnownAndMatched) {
  Image<float> known(6, 1, 10.0F);
  known.At(5, 0) = kUnknown;
  DisparityImage found(6, 1, Found(10.0));
  found.At(1, 0) = Found(10.5);
  found.At(2, 0) = Found(8.5);
  found.At(3, 0) = Found(14.5);
  found.At(4, 0) = Dropped(Drop::kPeak);
  const StereoScore score = ScoreAgainst(known, found);
  EXPECT_EQ(score.known, 5);
  EXPECT_EQ(score.matched, 4);
  EXPECT_DOUBLE_EQ(score.Density(), 0.8);
  // More than 0.5, 1, 2 and 4 px; an error of a threshold itself is not bad.
  EXPECT_EQ(score.bad, (std::array<std::int64_t, 4>{2, 2, 1, 1}));
  EXPECT_DOUBLE_EQ(score.BadShare(1), 0.5);
  EXPECT_DOUBLE_EQ(score.mean_error_px, 3.5 / 4.0);
  EXPECT_DOUBLE_EQ(score.rms_error_px, std::sqrt((0.25 + 2.25 + 20.25) / 4.0));
}

TEST(StereoScore, OfNothingIsNought) {
  const StereoScore unknown = ScoreAgainst(Image<float>(3, 2, kUnknown), DisparityImage(3, 2, 0));
  EXPECT_EQ(unknown.known, 0);
  EXPECT_EQ(unknown.Density(), 0.0);
  const StereoScore unmatched =
      ScoreAgainst(Image<float>(3, 2, 1.0F), DisparityImage(3, 2, Dropped(Drop::kBlob)));
  EXPECT_EQ(unmatched.known, 6);
  EXPECT_EQ(unmatched.BadShare(0), 0.0);
  EXPECT_EQ(unmatched.mean_error_px, 0.0);
}

}  // namespace
}  // namespace rockyard::vision
