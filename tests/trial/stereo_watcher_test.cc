// Who looks over the shoulder of stereo cameras is shown what the navigator gets, and changes
// nothing.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "trial/gestalt_trials.h"
#include "vision/cameras/triangulation.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using messages::LookDirection;

constexpr core::TrialKey kKey{1, 0};
const Overrides kBriefly = {"sensors.stereo.fidelity=image",
                            "sensors.stereo.images.pyramid_level=0", "rover.fidelity=quasi_static",
                            "referee.time_limit_s=200"};

struct Shown {
  std::vector<messages::PointCloud> clouds;   // of looks
  std::vector<messages::PointCloud> decided;  // of steps
  // Of each look its points, worked out anew from disparities and cameras.
  std::vector<std::vector<Vector3>> triangulated_R;
};

// Every pixel that is no farther from the left camera than the cameras reach.
std::vector<Vector3> Triangulated(const WatchedStereo& look, double max_range_m) {
  std::vector<Vector3> points_R;
  const vision::DisparityImage& disparities = look.sight.disparities;
  for (int y = 0; y < disparities.height(); ++y) {
    for (int x = 0; x < disparities.width(); ++x) {
      if (!vision::IsValid(disparities.At(x, y))) continue;
      const auto point = vision::Triangulate(look.pair.left, look.pair.right, vision::Pixel(x, y),
                                             vision::DisparityPx(disparities.At(x, y)));
      if (point && (point->p_A - look.pair.left.C).norm() <= max_range_m) {
        points_R.push_back(point->p_A);
      }
    }
  }
  return points_R;
}

DriveResult Watched(const DriveParams& drive, Shown& shown) {
  const auto on_look = [&](const WatchedStereo& look) {
    EXPECT_EQ(look.sight.left.width(), look.pair.size.columns);
    EXPECT_EQ(look.sight.left.height(), look.pair.size.rows);
    shown.clouds.push_back(look.cloud);
    shown.triangulated_R.push_back(Triangulated(look, drive.sensors.stereo.max_range_m));
  };
  const auto on_step = [&](const WatchedStep& step) { shown.decided.push_back(step.cloud); };
  return RunTrial(drive, kKey, nullptr, {.stereo = on_look, .step = on_step});
}

TEST(StereoWatcherTest, IsShownEveryLookAndChangesNothing) {
  const DriveParams drive = Gestalt("narrow_course", kBriefly);
  const DriveResult plain = RunTrial(drive, kKey);
  Shown shown;
  const DriveResult watched = Watched(drive, shown);
  EXPECT_THAT(Differences(plain, watched), testing::IsEmpty());
  ASSERT_GT(shown.clouds.size(), 2U);
  EXPECT_EQ(static_cast<double>(shown.clouds.size()), watched.record.image_sets);
  std::int64_t number = 0;
  for (const messages::PointCloud& cloud : shown.clouds) EXPECT_EQ(cloud.number, number++);
  const auto behind =
      std::count_if(shown.clouds.begin(), shown.clouds.end(),
                    [](const auto& cloud) { return cloud.direction == LookDirection::kBehind; });
  EXPECT_EQ(static_cast<double>(behind), watched.record.rear_image_sets);
  EXPECT_GT(behind, 0);
  ASSERT_FALSE(shown.decided.empty());
  for (const messages::PointCloud& cloud : shown.decided) {
    EXPECT_EQ(cloud.points_R, shown.clouds.at(static_cast<std::size_t>(cloud.number)).points_R);
  }
}

// Disparities and cameras lead to the points that are handed on, also where the calibration is
// wrong: the cameras are those that the rover believes to have.
TEST(StereoWatcherTest, CamerasAreThoseOfTheCalibration) {
  const Overrides wrong = {"perception.calibration.stereo_front.z_m=0.03",
                           "perception.calibration.stereo_front.pitch_deg=2",
                           "perception.calibration.stereo_rear.x_m=-0.04"};
  for (const Overrides& overrides : {Overrides{}, wrong}) {
    const DriveParams drive = Gestalt("narrow_course", kBriefly + overrides);
    Shown shown;
    Watched(drive, shown);
    ASSERT_FALSE(shown.clouds.empty());
    bool behind = false;
    for (std::size_t i = 0; i < shown.clouds.size(); ++i) {
      behind = behind || shown.clouds[i].direction == LookDirection::kBehind;
      const std::vector<Vector3>& handed_on = shown.clouds[i].points_R;
      const std::vector<Vector3>& worked_out = shown.triangulated_R[i];
      ASSERT_GT(handed_on.size(), 1000U);
      ASSERT_EQ(handed_on.size(), worked_out.size());
      for (std::size_t n = 0; n < handed_on.size(); ++n) {
        ASSERT_LT((handed_on[n] - worked_out[n]).norm(), 1e-9) << n;
      }
    }
    EXPECT_TRUE(behind);
  }
}

TEST(StereoWatcherTest, WithoutImagesNobodyIsCalled) {
  for (const char* fidelity : {"error_model", "ideal"}) {
    Shown shown;
    Watched(Gestalt("abundance", {std::string("sensors.stereo.fidelity=") + fidelity,
                                  "rover.fidelity=quasi_static", "referee.time_limit_s=60"}),
            shown);
    EXPECT_TRUE(shown.clouds.empty()) << fidelity;
    EXPECT_FALSE(shown.decided.empty()) << fidelity;
  }
}

}  // namespace
}  // namespace rockyard::trial
