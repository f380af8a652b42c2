// Every combination of way and turn three times.
#include "experiments/rendered_motions.h"

namespace rockyard::experiments {
namespace {

constexpr std::uint64_t kRuns = 60;

TEST(RenderedMotionsLongTest, ErrWithTheRightEyeAsTheirCovarianceSays) {
  ExpectHonest("right_eye", kRuns);
}

TEST(RenderedMotionsLongTest, ErrWithADisparityMapAsTheirCovarianceSays) {
  ExpectHonest("disparity_map", kRuns);
}

}  // namespace
}  // namespace rockyard::experiments
