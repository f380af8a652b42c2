// Twenty motions by the right eye, every combination of way and turn once: a covariance twice or
// half of what it should be is found with a probability of 0.97. Eight by a disparity map: four
// times or a quarter, with 0.99. The sixty of either in visual_motion_nees_long_test.cc find 1.5
// times or two thirds with 0.98.
#include "experiments/rendered_motions.h"

namespace rockyard::experiments {
namespace {

TEST(RenderedMotionsTest, ErrWithTheRightEyeAsTheirCovarianceSays) {
  ExpectHonest("right_eye", 20);
}

TEST(RenderedMotionsTest, ErrWithADisparityMapAsTheirCovarianceSays) {
  EXPECT_NE(MeasureMotions("disparity_map", 1).nees, MeasureMotions("right_eye", 1).nees);
  ExpectHonest("disparity_map", 8);
}

}  // namespace
}  // namespace rockyard::experiments
