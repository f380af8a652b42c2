#include "trial/counters/hazard_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "terrain/ground.h"

namespace rockyard::trial {
namespace {

terrain::Rock MakeRock(double x_m, double y_m, double a_m, double b_m, double yaw_rad,
                       double height_m) {
  terrain::Rock rock;
  rock.center_W = {x_m, y_m, 0.0};
  rock.semi_axes_m = {a_m, b_m, height_m};
  rock.yaw_rad = yaw_rad;
  rock.height_m = height_m;
  return rock;
}

math::Transform At(double x_m, double y_m, double heading_rad) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.translation() = math::Vector3(x_m, y_m, 0.0);
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()).matrix();
  return X_WR;
}

// Against points of the outline and the interior, tested one by one.
bool ReachesByPoints(const terrain::Rock& rock, const Zone& zone, const math::Transform& X_WR) {
  const math::Transform X_RW = X_WR.inverse();
  for (int ring = 0; ring <= 60; ++ring) {
    for (int i = 0; i < 720; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 720;
      const double u = rock.semi_axes_m.x() * ring / 60.0 * std::cos(angle);
      const double v = rock.semi_axes_m.y() * ring / 60.0 * std::sin(angle);
      const double c = std::cos(rock.yaw_rad);
      const double s = std::sin(rock.yaw_rad);
      const math::Vector3 p_R =
          X_RW * (rock.center_W + math::Vector3(c * u - s * v, s * u + c * v, 0.0));
      if (p_R.x() >= zone.x_low_m && p_R.x() <= zone.x_high_m && p_R.y() >= zone.y_low_m &&
          p_R.y() <= zone.y_high_m) {
        return true;
      }
    }
  }
  return false;
}

TEST(ReachesTest, AgreesWithPointsOfTheOutline) {
  const Zone zone{0.3, 0.6, -0.2, 0.35};
  core::RandomStream random({5, 0}, core::Purpose::kTest);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const double b_m = 0.05 + 0.1 * random.Uniform();
    const double a_m = b_m + 0.1 * random.Uniform();
    const terrain::Rock rock = MakeRock(1.2 * random.Uniform() - 0.1, 1.2 * random.Uniform() - 0.6,
                                        a_m, b_m, 3.0 * random.Uniform(), 0.2);
    const math::Transform X_WR = At(0.1, -0.1, 2.0 * random.Uniform() - 1.0);
    const bool expected = ReachesByPoints(rock, zone, X_WR);
    // A hair's breadth between the two is allowed.
    terrain::Rock larger = rock;
    larger.semi_axes_m *= 1.02;
    if (expected) {
      EXPECT_TRUE(Reaches(rock, zone, X_WR)) << i;
    } else if (!ReachesByPoints(larger, zone, X_WR)) {
      EXPECT_FALSE(Reaches(rock, zone, X_WR)) << i;
    }
    reached += expected;
  }
  EXPECT_GT(reached, 50);
  EXPECT_LT(reached, 250);
}

class HazardWatchTest : public testing::Test {
 protected:
  void Rocks(std::vector<terrain::Rock> rocks) {
    terrain_.emplace(terrain::Ground(), std::move(rocks), std::vector<terrain::Wall>{});
    watch_.emplace(ArrayZone({}), rover::RoverGeometryParams{}, 0.13, *terrain_);
  }
  void Drive(double from_m, double to_m, double y_m = 0.0) {
    for (double x_m = from_m; x_m < to_m; x_m += 0.01) watch_->Observe(At(x_m, y_m, 0.0));
  }

  std::optional<terrain::Terrain> terrain_;
  std::optional<HazardWatch> watch_;
};

TEST_F(HazardWatchTest, DrivingOntoWhatWasNotBelievedIsAMiss) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  Drive(0.0, 0.7);  // the array ends at 0.625 m ahead
  EXPECT_EQ(watch_->met(), 0);
  Drive(0.7, 0.9);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
  Drive(0.9, 2.5);  // the front is 0.325 m ahead
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 1);
}

TEST_F(HazardWatchTest, ABelievedHazardIsNoMiss) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  Drive(0.0, 0.9);
  watch_->OnBelieved(At(0.9, 0.0, 0.0));
  Drive(0.9, 2.5);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
}

TEST_F(HazardWatchTest, BeliefElsewhereDoesNotHelp) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  watch_->OnBelieved(At(0.0, 0.0, 0.0));
  Drive(0.0, 2.5);
  EXPECT_EQ(watch_->missed(), 1);
}

TEST_F(HazardWatchTest, LowRocksAndThoseBesideTheWayDoNotCount) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.129), MakeRock(2.5, 0.6, 0.12, 0.12, 0.0, 0.3)});
  Drive(0.0, 4.0);
  EXPECT_EQ(watch_->met(), 0);
  EXPECT_EQ(watch_->missed(), 0);
}

TEST_F(HazardWatchTest, MetBesideTheWheelsIsNoMiss) {
  Rocks({MakeRock(1.5, 0.42, 0.1, 0.1, 0.0, 0.3)});  // from 0.32; wheels end at 0.24
  Drive(0.0, 4.0);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
}

}  // namespace
}  // namespace rockyard::trial
