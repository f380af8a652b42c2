// The closed loop on rendered images: points of stereo at the image fidelity, and drives by them.
// Who looks over the shoulder of the cameras is shown what the navigator gets, and changes nothing.

#include "trial/eyes/stereo_eyes.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/refusals.h"
#include "sensing/stereo_view.h"
#include "trial/shipped_trials.h"
#include "trial/sight/stereo_reader.h"
#include "vision/cameras/rectification.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using messages::LookDirection;
using Points = std::vector<Vector3>;

constexpr core::TrialKey kKey{11, 4};
// Images as small as the range points, so that tests take no time; reduced ones where it says so.
const Overrides kImages = {"sensors.stereo.fidelity=image",
                           "sensors.stereo.images.pyramid_level=0"};

terrain::Terrain Flat() { return {terrain::Ground(), {}, {}}; }

Points Seen(const DriveParams& drive, const terrain::Terrain& terrain, LookDirection direction,
            const math::Transform& X_WR = math::Transform::Identity()) {
  RoverCameras cameras(drive, kKey);
  const LookData data = StereoEyes(drive, kKey, cameras).Look(terrain, X_WR, direction, 0);
  return StereoReader(drive).Points({.direction = direction}, data).points_R;
}

// A point of flat ground lies on the ray of a pixel whose true depth is where the ray meets z = 0:
// the error of its disparity is f b (1/Z - 1/Z_true).
struct DisparityErrors {
  double mean_px = 0.0;
  double deviation_px = 0.0;
};

DisparityErrors ErrorsOf(const Points& points_R, const sensing::StereoView& view) {
  const Vector3 axis = view.along_row.cross(view.along_column).normalized();
  const double scale_px_m = view.focal_px * view.baseline_m;
  double sum = 0.0;
  double squares = 0.0;
  for (const Vector3& p : points_R) {
    const Vector3 ray = p - view.eye;
    const double depth_m = std::abs(ray.dot(axis));
    const double true_depth_m = depth_m * view.eye.z() / -ray.z();
    const double error_px = scale_px_m * (1.0 / depth_m - 1.0 / true_depth_m);
    sum += error_px;
    squares += error_px * error_px;
  }
  const auto n = static_cast<double>(points_R.size());
  return {sum / n, std::sqrt(squares / n - (sum / n) * (sum / n))};
}

TEST(StereoEyesTest, FlatGroundIsSeenWhereItIsAheadAndBehind) {
  for (const std::string level : {"0", "2"}) {
    const DriveParams drive =
        Gestalt("abundance", kImages + Overrides{"sensors.stereo.images.pyramid_level=" + level});
    for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
      const Points seen = Seen(drive, Flat(), direction);
      ASSERT_GT(seen.size(), 2000U);
      const DisparityErrors errors =
          ErrorsOf(seen, sensing::MakeStereoView(drive.sensors.stereo, direction));
      EXPECT_LT(std::abs(errors.mean_px), 0.05);
      EXPECT_LT(errors.deviation_px, 0.3);
      for (const Vector3& p : seen) EXPECT_EQ(p.x() > 0.0, direction == LookDirection::kAhead);
    }
  }
}

TEST(StereoEyesTest, WithoutTextureThereIsLittleToMatch) {
  Overrides plain = kImages;
  for (const std::string end : {"drift", "gravel", "rock"}) {
    plain.push_back("sensors.look." + end + ".contrast=0");
    plain.push_back("sensors.look." + end + ".relief_slope=0");
  }
  const std::size_t textured =
      Seen(Gestalt("abundance", kImages), Flat(), LookDirection::kAhead).size();
  EXPECT_LT(5 * Seen(Gestalt("abundance", plain), Flat(), LookDirection::kAhead).size(), textured);
}

// A rock is where it is, and behind it nothing is seen.
TEST(StereoEyesTest, ARockRisesFromTheGround) {
  const DriveParams drive = Gestalt("abundance", kImages);
  const terrain::Rock rock{.center_W = {1.6, 0.0, 0.0},
                           .semi_axes_m = {0.25, 0.25, 0.35},
                           .diameter_m = 0.5,
                           .height_m = 0.35};
  const terrain::Terrain terrain{terrain::Ground(), {rock}, {}};
  int on_rock = 0;
  double highest_m = 0.0;
  for (const Vector3& p : Seen(drive, terrain, LookDirection::kAhead)) {
    if (std::hypot(p.x() - 1.6, p.y()) > 0.3) continue;
    ++on_rock;
    highest_m = std::max(highest_m, p.z());
  }
  EXPECT_GT(on_rock, 50);
  EXPECT_NEAR(highest_m, 0.35, 0.12);
}

TEST(StereoEyesTest, OnlyTheWindowIsHandedOnWhereItIsAskedFor) {
  const DriveParams drive =
      Gestalt("abundance", kImages + Overrides{"sensors.stereo.field_of_view=stripe"});
  const sensing::StripeWindowParams& window = drive.sensors.stereo.stripe_window;
  const Points seen = Seen(drive, Flat(), LookDirection::kAhead);
  ASSERT_GT(seen.size(), 20U);
  for (const Vector3& p : seen) {
    EXPECT_GE(p.x(), window.near_m);
    EXPECT_LE(p.x(), window.far_m);
    EXPECT_LE(std::abs(p.y()), window.half_width_m);
  }
  EXPECT_LT(seen.size(), Seen(Gestalt("abundance", kImages), Flat(), LookDirection::kAhead).size());
}

// The calibration is on board: what is photographed does not know of it.
TEST(StereoEyesTest, AWrongCalibrationMovesThePointsRigidly) {
  const auto cloud = [](const Overrides& overrides) {
    return Seen(Gestalt("abundance", kImages + overrides), Flat(), LookDirection::kAhead);
  };
  const Points right = cloud({});
  const Points wrong = cloud({"perception.calibration.stereo_front.z_m=0.02"});
  ASSERT_EQ(right.size(), wrong.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR((wrong[i] - right[i] - Vector3(0.0, 0.0, 0.02)).norm(), 0.0, 1e-12);
  }
}

TEST(StereoEyesTest, ADriveByImagesRepeatsBitForBitAndArrives) {
  const DriveParams drive = Gestalt("abundance", kImages + kShortAndEmpty);
  const DriveResult once = RunTrial(drive, kKey);
  EXPECT_THAT(Differences(once, RunTrial(drive, kKey)), testing::IsEmpty());
  EXPECT_EQ(once.outcome, truth::TrialOutcome::kGoalReached) << once.detail;
}

// Rays work out the outlines of ellipsoids; images show what is there.
TEST(StereoEyesTest, PointedRocksAreForImages) {
  const Overrides pointed = {"terrain.rocks.pointedness=0.5"};
  EXPECT_NO_THROW(Gestalt("abundance", kImages + pointed));
  EXPECT_THROW(Gestalt("abundance", pointed), core::UserError);
}

TEST(StereoEyesTest, ImagesThatAreTooLargeAreRefusedByName) {
  const Overrides large = {"sensors.stereo.fidelity=image", "sensors.stereo.columns=512",
                           "sensors.stereo.images.pyramid_level=3",
                           "sensors.stereo.max_disparity_px=64"};
  EXPECT_THAT(core::RefusalOf([&] { Gestalt("abundance", large); }),
              testing::HasSubstr("sensors.stereo.images.pyramid_level"));
}

constexpr core::TrialKey kWatchedTrial{1, 0};
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

// With the sand and the odometer for which it was found, the watched drive looks behind.
const Overrides kLooksBehind = {"terrain.ground.soil.law=bekker",
                                "perception.dead_reckoning.distance_scale=0.9465"};

DriveResult Watched(const DriveParams& drive, Shown& shown) {
  const auto on_look = [&](const WatchedStereo& look) {
    EXPECT_EQ(look.sight.left.width(), look.pair.size.columns);
    EXPECT_EQ(look.sight.left.height(), look.pair.size.rows);
    shown.clouds.push_back(look.cloud);
    shown.triangulated_R.push_back(Triangulated(look, drive.sensors.stereo.max_range_m));
  };
  const auto on_step = [&](const WatchedStep& step) { shown.decided.push_back(step.cloud); };
  return RunTrial(drive, kWatchedTrial, nullptr, {.stereo = on_look, .step = on_step});
}

TEST(StereoWatcherTest, IsShownEveryLookAndChangesNothing) {
  const DriveParams drive = Gestalt("narrow_course", kBriefly + kLooksBehind);
  const DriveResult plain = RunTrial(drive, kWatchedTrial);
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
    const DriveParams drive = Gestalt("narrow_course", kBriefly + kLooksBehind + overrides);
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
