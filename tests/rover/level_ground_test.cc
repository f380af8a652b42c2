// The rover on level ground against closed forms.
#include <gtest/gtest.h>

#include <numeric>

#include "rover_drive.h"

namespace rockyard::rover {
namespace {

TEST(LevelGround, DrivesStraight) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain();
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  std::printf("pose %.5f %.6f %.5f v %.5f\n", state.X_WR.translation().x(),
              state.X_WR.translation().y(), state.X_WR.translation().z(), state.v_WR_m_s.x());
  for (int i = 0; i < 6; ++i)
    std::printf("wheel %d angle %.4f load %.3f torque %.4f\n", i, state.wheel_angle_rad[i],
                state.wheel_load_N[i], state.motor_torque_Nm[i]);
  EXPECT_NEAR(state.X_WR.translation().x(), 1.5, 0.1);
}

}  // namespace
}  // namespace rockyard::rover
