// What tests of GESTALT on the move share.
#pragma once

#include <gtest/gtest.h>

#include "drive.h"

namespace rockyard::navigation {

using messages::LookDirection;
using messages::MotionKind;

inline GestaltSetup SetupOf(DriveCycle cycle) {
  GestaltSetup setup = TrueSetup();
  setup.goal = {8.0, 0.0};
  setup.params.continuous.cycle = cycle;
  setup.params.waypoints.goal_tolerance_m = 0.5;
  setup.params.drive.arrival_check = ArrivalCheck::kWhileDriving;
  setup.rover.speed_m_s = 0.07;
  return setup;
}

inline constexpr DriveCycle kOnTheMove[] = {DriveCycle::kCsod, DriveCycle::kCsad};

inline void SeeNearGroundOnly(GestaltSetup& setup) {
  setup.range.range_m = 1.2;
  setup.params.plan.plan_max_dist_m = setup.params.splines.length_m = 1.1;
}

// What holds for either cycle that looks on the move.
class OnTheMove : public testing::TestWithParam<DriveCycle> {
 protected:
  GestaltSetup setup_ = SetupOf(GetParam());
};

// Blocks hold no place of the vehicle's centre: obstacles grow by half its width, 0.42 m, in the
// map; a cell of 0.2 m may be half covered.
inline void ExpectClearOf(const GestaltDrive& drive, const Block& block) {
  for (const GestaltTick& tick : drive.log()) {
    ASSERT_FALSE(block.Holds(tick.X_WR.x_m, tick.X_WR.y_m, 0.42 - 0.1))
        << tick.X_WR.x_m << ", " << tick.X_WR.y_m;
  }
}

}  // namespace rockyard::navigation
