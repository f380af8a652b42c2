// Ten motions by the right eye: a covariance three times or a third of what it should be is found
// with a probability of 0.99. Six by a disparity map: four times or a quarter, with 0.98. The sixty
// of either in visual_motion_nees_long_test.cc find 1.5 times or two thirds with 0.98.
#include "experiments/rendered_motions.h"

namespace rockyard::experiments {
namespace {

TEST(RenderedMotionsTest, ErrWithTheRightEyeAsTheirCovarianceSays) {
  ExpectHonest("right_eye", 10);
}

TEST(RenderedMotionsTest, ErrWithADisparityMapAsTheirCovarianceSays) {
  EXPECT_NE(MeasureMotions("disparity_map", 1).nees, MeasureMotions("right_eye", 1).nees);
  ExpectHonest("disparity_map", 6);
}

}  // namespace
}  // namespace rockyard::experiments
