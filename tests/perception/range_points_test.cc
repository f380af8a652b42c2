// Points that stereo sees, and range points as an elevation array.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "perception/cloud_elevations.h"
#include "perception/hazard_detector.h"
#include "perception/stereo_points.h"
#include "vision/each_pixel.h"

namespace rockyard::perception {
namespace {

using math::Vector3;
using messages::LookDirection;
using messages::PointCloud;
using vision::CameraModel;
using vision::GrayImage;
using vision::Image;

// Range points as an elevation array, and stripes as range points.

// Bins of 0.25 x 0.2 m from 0.4 m on; a single point is enough.
CloudElevationParams Bins() {
  return {.near_m = 0.4, .far_m = 1.4, .half_width_m = 0.5, .quantile = 1.0, .min_points = 1};
}

// A point every 2 cm, at heights z(x, y).
template <typename Height>
PointCloud Ground(Height height) {
  PointCloud cloud;
  for (double x = 0.31; x < 1.6; x += 0.02) {
    for (double y = -0.79; y < 0.8; y += 0.02) cloud.points_R.emplace_back(x, y, height(x, y));
  }
  return cloud;
}

TEST(CloudElevationsTest, EachPointCountsInItsBin) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t stripe = 0; stripe < 5; ++stripe) {
      // Just within the bin's far right corner; stripes count from the left.
      const PointCloud cloud{
          .number = 9,
          .points_R = {{0.4 + 0.25 * static_cast<double>(row + 1) - 1e-6,
                        0.5 - 0.2 * static_cast<double>(stripe + 1) + 1e-6, 0.03}}};
      const messages::ElevationScan scan = CloudElevations(cloud, {}, Bins());
      EXPECT_EQ(scan.number, 9);
      ASSERT_EQ(scan.points.rows(), 4U);
      ASSERT_EQ(scan.points.stripes(), 5U);
      for (std::size_t i = 0; i < 20; ++i) {
        const messages::ElevationPoint& point = scan.points.points()[i];
        EXPECT_EQ(point.detected, i == 5 * row + stripe);
        EXPECT_EQ(point.elevation_m, point.detected ? 0.03 : 0.0);
      }
    }
  }
}

TEST(CloudElevationsTest, PointsBesideTheGroundDoNotCount) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  PointCloud cloud;
  cloud.points_R = {{0.39, 0.0, 1.0},  {1.41, 0.0, 1.0}, {0.7, 0.51, 1.0},
                    {0.7, -0.51, 1.0}, {-0.7, 0.0, 1.0}, {kNan, 0.0, 1.0}};
  const messages::ElevationScan scan = CloudElevations(cloud, {}, Bins());
  for (const auto& point : scan.points.points()) EXPECT_FALSE(point.detected);
}

TEST(CloudElevationsTest, AQuantileIsTheSmallestHeightThatEnoughPointsDoNotExceed) {
  PointCloud cloud;
  for (const double z : {0.5, 0.1, 0.4, 0.2, 0.3}) cloud.points_R.emplace_back(0.5, 0.0, z);
  CloudElevationParams params = Bins();
  for (const auto& [quantile, elevation_m] :
       {std::pair{1.0, 0.5}, {0.8, 0.4}, {0.5, 0.3}, {0.0, 0.1}}) {
    params.quantile = quantile;
    EXPECT_EQ(CloudElevations(cloud, {}, params).points[0][2].elevation_m, elevation_m);
  }
  params.min_points = 5;
  EXPECT_TRUE(CloudElevations(cloud, {}, params).points[0][2].detected);
  params.min_points = 6;
  EXPECT_FALSE(CloudElevations(cloud, {}, params).points[0][2].detected);
}

TEST(CloudElevationsTest, WhatLiesBehindIsSeenAsByARoverTurnedAround) {
  const PointCloud ahead = Ground([](double x, double y) { return 0.1 * x * x + 0.2 * y; });
  PointCloud behind = ahead;
  behind.direction = LookDirection::kBehind;
  for (Vector3& p : behind.points_R) p = {-p.x(), -p.y(), p.z()};
  const messages::ElevationScan seen = CloudElevations(behind, {}, Bins());
  const messages::ElevationScan expected = CloudElevations(ahead, {}, Bins());
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(seen.points.points()[i].elevation_m, expected.points.points()[i].elevation_m);
  }
}

TEST(CloudElevationsTest, LevelGroundIsFlatForARoverThatTiltsAndKnowsIt) {
  // The ground plane z_W = 0 as points of a rover pitched by 10 degrees and rolled by 5.
  const messages::AttitudeEstimate attitude{.roll_rad = math::DegToRad(5.0),
                                            .pitch_rad = math::DegToRad(10.0)};
  const math::Transform X_WR =
      math::MakePose(Vector3::Zero(), 0.0, attitude.pitch_rad, attitude.roll_rad);
  PointCloud cloud = Ground([](double, double) { return 0.0; });
  for (Vector3& p : cloud.points_R) p = X_WR.inverse() * p;
  CloudElevationParams params = Bins();
  const messages::ElevationScan scan = CloudElevations(cloud, attitude, params);
  for (const auto& point : scan.points.points()) {
    EXPECT_TRUE(point.detected);
    EXPECT_NEAR(point.elevation_m, 0.0, 1e-12);
  }
  EXPECT_FALSE(ReportHazards(scan, {}).any());
  // As the light stripe sensor has it, the same ground is a hazard.
  params.frame = ElevationFrame::kRover;
  EXPECT_TRUE(ReportHazards(CloudElevations(cloud, attitude, params), {}).any());
}

TEST(CloudElevationsTest, SlopesRaiseNeighbourDifferencesWithTheSpacingOfBins) {
  // Highest points of neighbouring bins of a slope differ by spacing x tangent: 0.25 x 0.2 = 5 cm.
  const auto scan = [](double tangent) {
    return CloudElevations(Ground([=](double x, double) { return tangent * x; }), {}, Bins());
  };
  const messages::ElevationScan slope = scan(0.19);
  // Points lie 2 cm apart.
  EXPECT_NEAR(slope.points[1][2].elevation_m - slope.points[0][2].elevation_m, 0.25 * 0.19, 0.004);
  HazardParams criteria{.range_threshold_m = 1.0};
  EXPECT_FALSE(ReportHazards(scan(0.17), criteria).any());
  EXPECT_TRUE(ReportHazards(scan(0.23), criteria).any());
  criteria.neighbour_threshold_m = 0.1;
  EXPECT_FALSE(ReportHazards(scan(0.23), criteria).any());
}

// From its plane a slope is flat, up and across, and a rock on it as high as on the level; as
// printed, from the level, the slope is a hazard all over. Ground that is too steep stays one.
TEST(CloudElevationsTest, FromThePlaneSlopesAreFlatAndRocksAreNot) {
  const auto report = [](ElevationFrame frame, double slope_deg, double rock_m, bool across) {
    const double tangent = std::tan(math::DegToRad(slope_deg));
    const PointCloud cloud = Ground([=](double x, double y) {
      const bool rock = std::hypot(x - 1.0, y - 0.2) < 0.12;
      return tangent * (across ? y : x) + (rock ? rock_m : 0.0);
    });
    CloudElevationParams params = Bins();
    params.frame = frame;
    return ReportHazards(CloudElevations(cloud, {}, params), {});
  };
  for (const bool across : {false, true}) {
    EXPECT_TRUE(report(ElevationFrame::kLevel, 15.0, 0.0, across).any());
    EXPECT_FALSE(report(ElevationFrame::kPlane, 15.0, 0.0, across).any());
    EXPECT_TRUE(report(ElevationFrame::kPlane, 30.0, 0.0, across).any());
    const messages::HazardReport rock = report(ElevationFrame::kPlane, 15.0, 0.2, across);
    EXPECT_EQ(rock.stripe_hazard, report(ElevationFrame::kLevel, 0.0, 0.2, across).stripe_hazard);
    EXPECT_TRUE(rock.any());
  }
}

// A wall across the far quarter does not tilt the ground before it.
TEST(CloudElevationsTest, TheGroundBeforeAWallStaysGround) {
  CloudElevationParams params = Bins();
  params.frame = ElevationFrame::kPlane;
  const auto wall = [](double x, double) { return 0.1 * x + (x > 1.2 ? 0.3 : 0.0); };
  const messages::ElevationScan scan = CloudElevations(Ground(wall), {}, params);
  for (std::size_t stripe = 0; stripe < 5; ++stripe) {
    EXPECT_NEAR(scan.points[0][stripe].elevation_m, 0.0, 0.005);
    EXPECT_NEAR(scan.points[3][stripe].elevation_m, 0.3, 0.005);
  }
}

TEST(CloudElevationsTest, ParametersThatLeaveNoGroundAreRefused) {
  for (const char* json : {R"({"far_m": 0.2})", R"({"half_width_m": 0})", R"({"rows": 1})",
                           R"({"stripes": 10})", R"({"quantile": 1.1})", R"({"min_points": 0})"}) {
    CloudElevationParams params;
    EXPECT_THROW(core::ReadParams(core::ParseJson(json, "test"), params), core::UserError) << json;
  }
}

// Two cameras looking down at 45 degrees and one fan straight ahead.
messages::StripeCalibration Calibration() {
  messages::StripeCalibration calibration;
  for (messages::Camera& camera : calibration.cameras) {
    camera.X_RC = math::MakePose({0.27, 0.06, 0.25}, 0.0, math::DegToRad(45.0), 0.0);
    camera.column_pitch_rad = 0.0024;
    camera.row_pitch_rad = 0.0028;
    camera.columns = 768;
    camera.rows = 484;
  }
  calibration.scanline_px = {0, -100};
  calibration.lasers = {{.p_RoE_R = {0.27, 0.0, 0.25}}};
  calibration.datum_z_m = 0.02;
  return calibration;
}

TEST(StripeCloudTest, PointsAreThoseWhoseElevationsAreKnown) {
  const Triangulator triangulator(Calibration());
  messages::StripeScan scan{.number = 4,
                            .pixels = messages::StripeArray<messages::StripePixel>({2, 1})};
  scan.pixels[0][0] = {.detected = true, .column_px = 70.0};
  const PointCloud cloud = StripeCloud(scan, triangulator);
  EXPECT_EQ(cloud.number, 4);
  ASSERT_EQ(cloud.points_R.size(), 1U);
  const auto elevations = triangulator.Elevations(scan);
  EXPECT_NEAR(cloud.points_R[0].z() - 0.02, elevations.points[0][0].elevation_m, 1e-12);
  EXPECT_NEAR(cloud.points_R[0].y(), 0.0, 1e-12);  // in the light plane
  EXPECT_GT(cloud.points_R[0].x(), 0.27);
}

// From images of a plane with a known texture to points: each camera's image is painted by casting
// the rays of its pixels onto the plane, without any of the stages that are under test.

constexpr vision::ImageSize kSize{96, 80};

// A sum of waves in many directions, 2 to 8 pixels long at the plane's distance.
class Texture {
 public:
  explicit Texture(double pixel_m) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (Wave& wave : waves_) {
      const double angle = 6.283185307179586 * share(random);
      const double number = 6.283185307179586 / (pixel_m * (3.0 + 6.0 * share(random)));
      wave = {number * std::cos(angle), number * std::sin(angle), 6.3 * share(random)};
    }
  }

  double At(double y_m, double z_m) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.y * y_m + wave.z * z_m + wave.phase);
    return 128.0 + 25.0 * sum / std::sqrt(static_cast<double>(waves_.size()) / 2.0);
  }

 private:
  struct Wave {
    double y, z, phase;
  };
  std::array<Wave, 40> waves_{};
};

// Looks along x of R, at height 0.5 m; `focal_px` along rows, 1.2 times as much along columns.
vision::Cahv LinearAt(double y_m, const vision::ImageSize& size, double focal_px) {
  const Vector3 axis(1.0, 0.0, 0.0);
  return {{0.1, y_m, 0.5},
          axis,
          Vector3(0.0, -focal_px, 0.0) + 0.5 * (size.columns - 1) * axis,
          Vector3(0.0, 0.0, -1.2 * focal_px) + 0.5 * (size.rows - 1) * axis};
}

Image<std::uint8_t> AllFree(const vision::ImageSize& size) { return {size.columns, size.rows, 1}; }

vision::StereoRig LinearRig(const vision::ImageSize& size = kSize, double focal_px = 60.0) {
  return {{LinearAt(0.06, size, focal_px), size},
          {LinearAt(-0.06, size, focal_px), size},
          AllFree(size),
          AllFree(size)};
}

// The wall x = wall_m as a camera sees it, each pixel the mean of 3 x 3 rays.
GrayImage Seen(const CameraModel& camera, double wall_m, const Texture& texture) {
  GrayImage image(camera.size.columns, camera.size.rows);
  vision::ForEachPixel(image.width(), image.height(), [&](int column, int row) {
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
      const vision::Pixel part(column + (i % 3 - 1) / 3.0, row + (i / 3 - 1) / 3.0);
      const vision::Ray ray = *vision::BackProject(camera, part);
      const double way = (wall_m - ray.origin.x()) / ray.direction.x();
      const Vector3 p = ray.origin + way * ray.direction;
      sum += texture.At(p.y(), p.z());
    }
    image.At(column, row) = static_cast<std::uint8_t>(std::clamp(sum / 9.0, 0.0, 255.0));
  });
  return image;
}

StereoSearch Search(int level = 0) {
  return {.pyramid_level = level,
          .min_disparity_px = 1.0,
          .max_disparity_px = 16.0,
          .max_range_m = 5.0};
}

// Of the wall of disparity 60 px * 0.12 m / (wall - 0.1 m).
constexpr double kWall_m = 1.0;
constexpr double kPixel_m = 0.9 / 60.0;

StereoSight See(const vision::StereoRig& rig, const StereoSearch& search,
                const StereoMatchingParams& params = {}) {
  const Texture texture(kPixel_m);
  return StereoPoints(params, search, rig)
      .See(Seen(rig.left, kWall_m, texture), Seen(rig.right, kWall_m, texture));
}

// All but one point of a hundred. sigma_x = Z^2 sigma_d / (f b): a tenth of a pixel is 11 mm here.
void ExpectTheWall(const std::vector<Vector3>& points_R, double most_off_m) {
  double sum_m = 0.0;
  std::size_t off = 0;
  for (const Vector3& p : points_R) {
    off += std::abs(p.x() - kWall_m) > most_off_m ? 1 : 0;
    sum_m += p.x();
  }
  EXPECT_LT(off, points_R.size() / 100);
  EXPECT_NEAR(sum_m / static_cast<double>(points_R.size()), kWall_m, 0.2 * most_off_m);
}

TEST(StereoPointsTest, ALinearPairWithLongPixelsSeesTheWallWhereItIs) {
  const StereoSight sight = See(LinearRig(), Search());
  EXPECT_GT(sight.points_R.size(), 3500U);
  ExpectTheWall(sight.points_R, 0.06);
  EXPECT_EQ(sight.left.width(), kSize.columns);
  // Every point lies on the ray of its pixel: the rays of an image of 96 x 80 reach 0.7 m aside.
  for (const Vector3& p : sight.points_R) {
    const auto pixel = vision::Project(LinearRig().left, p);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), std::round(pixel->x()), 1e-9);
    EXPECT_NEAR(pixel->y(), std::round(pixel->y()), 1e-9);
  }
}

TEST(StereoPointsTest, ImagesAreReducedBeforeTheyAreMatched) {
  const vision::ImageSize large{192, 160};
  const StereoSight sight = See(LinearRig(large, 120.0), Search(1));
  EXPECT_EQ(sight.left.width(), 96);
  EXPECT_EQ(sight.disparities.height(), 80);
  EXPECT_GT(sight.points_R.size(), 3500U);
  ExpectTheWall(sight.points_R, 0.06);
}

// Distorted, and turned against each other: without resampling nothing would match.
TEST(StereoPointsTest, CamerasThatAreNotAlignedAreResampled) {
  const auto camera = [](double y_m, double yaw_rad, double roll_rad) {
    vision::BrownPinhole lens;
    lens.X_AC.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
    lens.X_AC.prerotate(Eigen::AngleAxisd(yaw_rad, Vector3::UnitZ()) *
                        Eigen::AngleAxisd(roll_rad, Vector3::UnitX()));
    lens.X_AC.translation() = Vector3(0.1, y_m, 0.5);
    lens.fx_px = lens.fy_px = 60.0;
    lens.cx_px = 47.5;
    lens.cy_px = 39.5;
    lens.k1 = -0.1;
    return CameraModel{lens, kSize};
  };
  const vision::StereoRig rig{camera(0.06, 0.03, 0.04), camera(-0.06, -0.02, -0.04), AllFree(kSize),
                              AllFree(kSize)};
  const StereoSight sight = See(rig, Search());
  EXPECT_GT(sight.points_R.size(), 2500U);
  ExpectTheWall(sight.points_R, 0.08);
}

TEST(StereoPointsTest, WhatIsOutOfRangeIsDropped) {
  // The wall's disparity is 8 px.
  StereoSearch search = Search();
  search.min_disparity_px = 8.5;
  EXPECT_LT(See(LinearRig(), search).points_R.size(), 100U);
  search.min_disparity_px = 1.0;
  search.max_disparity_px = 7.5;
  EXPECT_LT(See(LinearRig(), search).points_R.size(), 100U);
  // Whole disparities are searched beyond the ends, points beyond them are not handed on.
  search.max_disparity_px = 8.0;
  const StereoSight half = See(LinearRig(), search);
  EXPECT_GT(half.points_R.size(), 300U);
  for (const Vector3& p : half.points_R) EXPECT_GE(p.x(), kWall_m - 1e-9);
  // From the left eye the middle of the wall is 0.9 m away, its corners more.
  search = Search();
  search.max_range_m = 0.95;
  const StereoSight near = See(LinearRig(), search);
  EXPECT_GT(near.points_R.size(), 300U);
  for (const Vector3& p : near.points_R) EXPECT_LE((p - Vector3(0.1, 0.06, 0.5)).norm(), 0.95);
}

// A window of 7 reaches 3 pixels to either side.
TEST(StereoPointsTest, NoPointComesFromAWindowThatSharesAPixelWithTheRover) {
  vision::StereoRig rig = LinearRig();
  for (int row = 60; row < kSize.rows; ++row) {
    for (int column = 40; column < 50; ++column) rig.left_free.At(column, row) = 0;
  }
  const StereoSight masked = See(rig, Search());
  const StereoSight whole = See(LinearRig(), Search());
  int lost = 0;
  vision::ForEachPixel(kSize.columns, kSize.rows, [&](int column, int row) {
    const bool touches = row >= 57 && column >= 37 && column < 53;
    const bool before = vision::IsValid(whole.disparities.At(column, row));
    const bool after = vision::IsValid(masked.disparities.At(column, row));
    EXPECT_EQ(after, before && !touches) << column << ", " << row;
    lost += before && touches ? 1 : 0;
  });
  EXPECT_GT(lost, 100);
}

TEST(StereoPointsTest, AReducedPixelIsTheRoversWhereAnyOfItsPixelsIs) {
  vision::StereoRig rig = LinearRig({192, 160}, 120.0);
  rig.left_free.At(101, 81) = 0;  // of pixel (50, 40)
  const StereoSight masked = See(rig, Search(1));
  for (int row = 37; row <= 43; ++row) {
    for (int column = 47; column <= 53; ++column) {
      EXPECT_FALSE(vision::IsValid(masked.disparities.At(column, row)));
    }
  }
  EXPECT_TRUE(vision::IsValid(masked.disparities.At(54, 40)));
}

TEST(StereoPointsTest, CamerasThatCannotBeAlignedAreRefused) {
  vision::StereoRig rig = LinearRig();
  rig.right = rig.left;
  EXPECT_THROW(StereoPoints({}, Search(), rig), core::UserError);
}

}  // namespace
}  // namespace rockyard::perception
