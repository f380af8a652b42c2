// The bounds of ACE over a million poses.
#include "navigation/enav/stance.h"

namespace rockyard::navigation {
namespace {

TEST(AceLong, BoundsAMillionStances) {
  AceParams params;
  params.wheel_box_diameters = 2.0;
  params.wheel_box_widths = 3.0;
  params.max_wheel_drop_radii = 0.0;
  const BoundsHeld held = HoldBounds(params, PerseveranceLike(), 20261130, 1000, 1000);
  EXPECT_GT(held.poses, 950000);
  EXPECT_EQ(held.left_box, 0);
  EXPECT_EQ(held.violations, 0);
  const auto poses = static_cast<double>(held.poses);
  constexpr const char* kStates[] = {"roll",       "pitch",       "rocker",
                                     "left_bogie", "right_bogie", "origin"};
  for (std::size_t i = 0; i < held.width.size(); ++i) {
    RecordProperty(std::string(kStates[i]) + "_mean_width",
                   testing::PrintToString(held.width[i] / poses));
  }
  RecordProperty("clearance_mean_gap_m", testing::PrintToString(held.clearance_gap_m / poses));
}

}  // namespace
}  // namespace rockyard::navigation
