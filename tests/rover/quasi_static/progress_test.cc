// Starts and stops of the quasi-static rover against closed forms.
#include "rover/quasi_static/progress.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::rover {
namespace {

// 20 kg at 15 cm/s on wheels that pull 100 N by Coulomb friction.
SteadyDrive OnRock() {
  SteadyDrive drive;
  drive.rock = {.traction_N = 100.0, .rim_m_s = 0.15, .along_m_s = 0.15};
  drive.inertia_J = 20.0 * 0.15 * 0.15;
  return drive;
}

double WayOf(Progress& progress, double rim, double time_s) {
  double way_s = 0.0;
  for (int i = 0; i < static_cast<int>(std::lround(time_s / 0.05)); ++i) {
    way_s += progress.Advance(rim, rim, 0.05);
  }
  return way_s;
}

// Rims that jump drag a rover that slides by F = T: it loses v / (2 a) of a second, a = T / m, and
// makes as much when they stop at once.
TEST(Progress, JumpsCostAndGainTheTimeOfSliding) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  const double sliding_s = 0.15 / (2.0 * 100.0 / 20.0);
  EXPECT_NEAR(WayOf(progress, 1.0, 1.0), 1.0 - sliding_s, 1e-3);
  EXPECT_NEAR(progress.speed(), 1.0, 1e-3);
  EXPECT_NEAR(WayOf(progress, 0.0, 1.0), sliding_s, 1e-3);
  EXPECT_EQ(progress.speed(), 0.0);
}

TEST(Progress, SteadyMotionMakesAllOfItsWay) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  WayOf(progress, 1.0, 1.0);
  EXPECT_EQ(progress.Advance(1.0, 1.0, 0.05), 0.05);
}

TEST(Progress, AnotherMotionKeepsItsShareOfTheSpeed) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  WayOf(progress, 1.0, 1.0);
  progress.Begin(OnRock(), 0.25);
  EXPECT_NEAR(progress.speed(), 0.25, 1e-3);
  progress.Begin(OnRock(), 0.0);
  EXPECT_EQ(progress.speed(), 0.0);
}

// Wheels without any traction neither start a rover nor keep it rolling: it is where its rims are.
TEST(Progress, WithoutTractionTheRimsDecide) {
  Progress progress;
  SteadyDrive drive = OnRock();
  drive.rock.traction_N = 0.0;
  progress.Begin(drive, 1.0);
  EXPECT_EQ(progress.Advance(0.0, 1.0, 0.1), 0.05);
  progress.Advance(0.0, 0.0, 0.1);
  EXPECT_EQ(progress.speed(), 0.0);
}

// Soil in its linear range, F = T u / 2 with u = (l / K) i: the rover follows jumped rims as
// 1 - e^(-t / s), s = 2 m v / (T l / K), and loses s in all, whatever the step.
TEST(Progress, LinearSlipLosesItsTimeConstant) {
  Progress progress;
  SteadyDrive drive;
  drive.soil = {.traction_N = 100.0, .rim_m_s = 0.15, .along_m_s = 0.15, .shear_ratio = 0.02};
  drive.inertia_J = 20.0 * 0.15 * 0.15;
  progress.Begin(drive, 1.0);
  const double constant_s = 2.0 * 20.0 * 0.15 / (100.0 * 0.02);
  EXPECT_NEAR(WayOf(progress, 1.0, 12.0 * constant_s), 11.0 * constant_s, 0.02 * constant_s);
}

TEST(ShareTable, IsTheCurveOfShear) {
  const ShareTable table;
  for (double u = 0.0; u < 40.0; u += 0.0137) {
    const ShearShare expected = ShareOfRatio(u);
    EXPECT_NEAR(table.At(u).value, expected.value, 1e-7) << u;
    EXPECT_NEAR(table.At(u).slope, expected.slope, 2e-5) << u;
  }
}

}  // namespace
}  // namespace rockyard::rover
