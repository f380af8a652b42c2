// Stereo cameras: what users may ask of them and what is refused, their images, and the jumps of
// depth in them.
#include "sensing/stereo_imager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/params_text.h"
#include "rendering/picture/picture_renderer.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/terrain_look.h"
#include "sensing/rover_parts.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_view.h"
#include "stereo_scene.h"
#include "stripe_scene.h"
#include "vision/each_pixel.h"

namespace rockyard::sensing {
namespace {

using messages::LookDirection;

// What users may ask of the stereo cameras, and what is refused.

void ExpectRefused(const std::string& json, const std::string& field) {
  EXPECT_THAT(core::ProblemsOf<StereoParams>(json), testing::HasSubstr(field)) << json;
}

TEST(StereoParamsTest, LayoutsThatCannotWorkAreRefused) {
  ExpectRefused(R"({"front": {"pitch_deg": -60}})", "front");  // sky alone
  ExpectRefused(R"({"rear": {"pitch_deg": -44.5}})", "rear");
  ExpectRefused(R"({"front": {"height_m": 4.5}})", "front");  // ground out of range
  ExpectRefused(R"({"baseline_m": 0})", "baseline_m");
  ExpectRefused(R"({"horizontal_fov_deg": 0})", "horizontal_fov_deg");
  ExpectRefused(R"({"vertical_fov_deg": 180})", "vertical_fov_deg");
  ExpectRefused(R"({"columns": 0})", "columns");
  ExpectRefused(R"({"rows": 100000})", "rows");
  ExpectRefused(R"({"disparity_noise_px": -1})", "disparity_noise_px");
  ExpectRefused(R"({"dropout_probability": 1})", "dropout_probability");
  ExpectRefused(R"({"min_disparity_px": 20})", "max_disparity_px");
  ExpectRefused(R"({"max_disparity_px": 1, "max_range_m": 2})", "max_disparity_px");
  ExpectRefused(R"({"horizontal_fov_deg": 10})", "max_disparity_px");
  ExpectRefused(R"({"stripe_window": {"near_m": 0.7}})", "stripe_window.far_m");
  ExpectRefused(R"({"stripe_window": {"half_width_m": 0}})", "stripe_window.half_width_m");
  ExpectRefused(R"({"field_of_view": "stripe", "stripe_window": {"far_m": 9}})", "stripe_window");
}

TEST(StereoParamsTest, ExtremesThatAreAcceptedWork) {
  for (const char* json : {
           R"({"columns": 8, "rows": 8, "horizontal_fov_deg": 150, "vertical_fov_deg": 150})",
           R"({"horizontal_fov_deg": 1, "vertical_fov_deg": 1, "max_disparity_px": 1000})",
           R"({"front": {"pitch_deg": 90}, "rear": {"pitch_deg": 90}, "baseline_m": 0.5})",
           R"({"front": {"pitch_deg": -43}, "max_range_m": 20})",
           R"({"disparity_noise_px": 5, "disparity_step_px": 4, "dropout_probability": 0.999})",
           R"({"edge_reach_px": 100, "edge_disparity_px": 0.01, "min_disparity_px": 0.001})",
           R"({"fidelity": "ideal", "horizontal_fov_deg": 10})",
           R"({"noise_window_px": 31, "mismatch_probability": 0.999})",
           R"({"max_disparity_px": 2, "field_of_view": "stripe"})",
       }) {
    StereoParams params;
    ASSERT_NO_THROW(core::ReadParams(core::ParseJson(json, "test"), params)) << json;
    const terrain::Terrain terrain = FlatWith({EllipsoidRock(1.0, 0.2, 0.0, 0.3, 0.2, 0.2)});
    for (const math::Vector3& p_R : LookAhead(params, terrain, PoseAt(0, 0, 0)).points_R) {
      ASSERT_TRUE(p_R.allFinite()) << json;
    }
  }
}

TEST(StereoParamsTest, StoredCamerasSeeTheGroundOfTheLightStripes) {
  const std::filesystem::path folder =
      std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios" / "sensors";
  for (const char* name :
       {"stereo_athena_sdm.json", "stereo_rocky_3_2.json", "stereo_matthies_1995.json"}) {
    StereoParams params = NoiselessStereo();
    ASSERT_NO_THROW(core::ReadParams(core::LoadJsonFile(folder / name), params)) << name;
    params.field_of_view = StereoFieldOfView::kStripe;
    const StripeWindowParams& window = params.stripe_window;
    double near_m = window.far_m;
    double far_m = window.near_m;
    double half_width_m = 0.0;
    for (const math::Vector3& p_R : LookAhead(params, FlatWith({}), PoseAt(0, 0, 0)).points_R) {
      near_m = std::min(near_m, p_R.x());
      far_m = std::max(far_m, p_R.x());
      half_width_m = std::max(half_width_m, std::abs(p_R.y()));
    }
    // The whole window, but for the spacing of rays.
    EXPECT_NEAR(near_m, window.near_m, 0.02) << name;
    EXPECT_NEAR(far_m, window.far_m, 0.02) << name;
    EXPECT_NEAR(half_width_m, window.half_width_m, 0.02) << name;
  }
}

// Stereo cameras down to images: their geometry, their mask, their noise.

constexpr core::TrialKey kKey{7, 3};

StereoParams Images(std::int64_t level) {
  StereoParams params{.fidelity = StereoFidelity::kImage, .columns = 32, .rows = 24};
  params.images.pyramid_level = level;
  return params;
}

StereoImager ImagerOf(const StereoParams& params, const rover::RoverGeometryParams& rover = {}) {
  return {params, {}, {}, rover, kKey};
}

// The point at depth Z on the ray of a pixel of the view, told by another formula, lands on that
// pixel of the reduced left image and f b / Z columns further left in the right one.
TEST(StereoImagerTest, CamerasSeeAsTheViewOfTheRangePointsDoes) {
  for (const std::int64_t level : {0, 2}) {
    const StereoParams params = Images(level);
    for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
      const StereoView view = MakeStereoView(params, direction);
      const vision::StereoRig rig = CalibratedRig(params, {}, direction);
      EXPECT_EQ(rig.left.size, (vision::ImageSize{32 << level, 24 << level}));
      const vision::CameraModel left = vision::Reduced(rig.left, 1 << level);
      const vision::CameraModel right = vision::Reduced(rig.right, 1 << level);
      for (const auto& [column, row] : {std::pair{0, 0}, {31, 23}, {10, 17}}) {
        const double depth_m = 0.7 + 0.1 * row;
        const math::Vector3 p_R = view.eye + depth_m * view.Ray(column, row);
        const vision::Pixel seen = *vision::Project(left, p_R);
        EXPECT_NEAR(seen.x(), column, 1e-9);
        EXPECT_NEAR(seen.y(), row, 1e-9);
        const vision::Pixel other = *vision::Project(right, p_R);
        EXPECT_NEAR(other.x(), column - view.focal_px * params.baseline_m / depth_m, 1e-9);
        EXPECT_NEAR(other.y(), row, 1e-9);
      }
    }
  }
}

// The renderer says which surface each pixel shows: the mask has to name the rover's own.
TEST(StereoImagerTest, TheMaskIsWhereAPictureShowsTheRover) {
  StereoParams params = Images(1);
  params.front.ahead_m = -0.2;  // behind the front of the body, above it
  params.front.height_m = 0.6;
  const rover::RoverGeometryParams rover;
  const vision::StereoRig rig = CalibratedRig(params, rover, LookDirection::kAhead);
  const rendering::RoverBody body = MakeRoverBody(rover);
  const terrain::Terrain& terrain = Flat();
  // High above the ground: nothing stands between the camera and the rover's parts.
  const math::Transform X_WR = math::MakePose({0.0, 0.0, 1.0}, 0.0, 0.0, 0.0);
  const rendering::PictureScene scene(terrain, {}, {}, 200e-9, {&body, X_WR});
  const rendering::PixelRays rays(rig.left);
  rendering::TerrainLook look(terrain, {}, {}, kKey);
  rendering::Picture picture(rays.columns(), rays.rows());
  rendering::PictureRenderer(scene, {}, rays, X_WR).RenderRows(0, rays.rows(), look, picture);
  int hidden = 0;
  vision::ForEachPixel(rays.columns(), rays.rows(), [&](int column, int row) {
    const bool rover_there = picture.surface.At(column, row) == rendering::SurfacePoint::kRover;
    EXPECT_EQ(rig.left_free.At(column, row) == 0, rover_there) << column << ", " << row;
    hidden += rover_there ? 1 : 0;
  });
  EXPECT_GT(hidden, 100);
  EXPECT_LT(hidden, rays.columns() * rays.rows() - 100);
  EXPECT_FALSE(rig.left_free == rig.right_free);
}

double MeanDifference(const vision::GrayImage& a, const vision::GrayImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    sum += std::abs(a.values()[i] - b.values()[i]);
  }
  return sum / static_cast<double>(a.values().size());
}

TEST(StereoImagerTest, LooksRepeatBitForBitAndDifferInNoiseFromLookToLook) {
  const StereoImager imager = ImagerOf(Images(1));
  const auto see = [](const StereoImager& by, std::int64_t look,
                      LookDirection direction = LookDirection::kAhead) {
    return by.Expose(Flat(), PoseAt(0.0, 0.0, 0.0, 0.3), look, direction);
  };
  const StereoImages first = see(imager, 5);
  const StereoImages again = see(imager, 5);
  EXPECT_EQ(first.left, again.left);
  EXPECT_EQ(first.right, again.right);
  EXPECT_DOUBLE_EQ(first.exposure_s, again.exposure_s);
  const StereoImages next = see(imager, 6);
  const double noise = MeanDifference(first.left, next.left);
  EXPECT_GT(noise, 0.05);
  EXPECT_LT(noise, 3.0);  // the ground itself is the same
  // The two eyes and the two pairs see other ground.
  EXPECT_GT(MeanDifference(first.left, first.right), noise);
  EXPECT_GT(MeanDifference(first.left, see(imager, 5, LookDirection::kBehind).left), noise);
  // A camera that is noiseless shows the same in both looks, so that it was noise.
  StereoParams quiet = Images(1);
  quiet.images.camera.imager.ccd.full_well_e = 1e7;
  quiet.images.camera.imager.ccd.read_noise_e = 0.0;
  const StereoImager silent = ImagerOf(quiet);
  EXPECT_LT(MeanDifference(see(silent, 5).left, see(silent, 6).left), 0.5 * noise);
}

// A right camera that has turned by e shows what its axis looks at f e columns away: the pair is
// told as it was calibrated, and the disparities are wrong by some f e.
TEST(StereoImagerTest, ADriftedPairIsToldAsItWasCalibrated) {
  StereoParams params = Images(1);
  const StereoImager stiff = ImagerOf(params);
  const StereoParams calibrated = params;
  params.images.drift.yaw_sd_rad = 0.01;
  const StereoImager drifted = ImagerOf(params);
  const math::Transform X_WR = math::Transform::Identity();
  for (const LookDirection direction : {LookDirection::kAhead, LookDirection::kBehind}) {
    const vision::StereoRig told = CalibratedRig(params, {}, direction);
    const vision::StereoRig before = CalibratedRig(calibrated, {}, direction);
    EXPECT_TRUE(told.right_free == before.right_free);
    EXPECT_EQ(std::get<vision::Cahv>(told.right.lens), std::get<vision::Cahv>(before.right.lens));
  }
  const auto shift_px = [&](LookDirection direction) {
    const vision::Image<float> a = stiff.TrueDisparities(Flat(), X_WR, direction);
    const vision::Image<float> b = drifted.TrueDisparities(Flat(), X_WR, direction);
    const int column = a.width() / 2;
    const int row = a.height() / 2;
    return static_cast<double>(b.At(column, row) - a.At(column, row));
  };
  const double deviation_px = 2.0 * params.focal_columns_px() * 0.01;
  const double ahead_px = shift_px(LookDirection::kAhead);
  const double behind_px = shift_px(LookDirection::kBehind);
  for (const double px : {ahead_px, behind_px}) {
    EXPECT_GT(std::abs(px), 1e-3 * deviation_px);
    EXPECT_LT(std::abs(px), 6.0 * deviation_px);
  }
  EXPECT_NE(ahead_px, behind_px);
  const StereoImages before = stiff.Expose(Flat(), X_WR, 0, LookDirection::kAhead);
  const StereoImages after = drifted.Expose(Flat(), X_WR, 0, LookDirection::kAhead);
  EXPECT_EQ(before.left, after.left);
  EXPECT_FALSE(before.right == after.right);
}

// All but brightest_share of the pixels are to lie below target_fill of the largest count.
TEST(StereoImagerTest, BothEyesAreExposedForTheTimeThatTheLeftOneAsksFor) {
  const StereoParams params = Images(1);
  const StereoImages images =
      ImagerOf(params).Expose(Flat(), math::Transform::Identity(), 0, LookDirection::kAhead);
  const double limit = 255.0 * params.images.camera.imager.exposure.target_fill;
  for (const vision::GrayImage* image : {&images.left, &images.right}) {
    int above = 0;
    double sum = 0.0;
    for (const std::uint8_t value : image->values()) {
      above += value > limit + 10.0 ? 1 : 0;
      sum += value;
    }
    EXPECT_LT(above, 0.02 * static_cast<double>(image->values().size()));
    EXPECT_GT(sum / static_cast<double>(image->values().size()), 0.4 * limit);
  }
  EXPECT_GT(images.exposure_s, params.images.camera.imager.exposure.shortest_s);
}

std::vector<int> Distances(const std::vector<double>& row_px, double jump_px = 1.0) {
  std::vector<int> distances(row_px.size());
  JumpDistances(row_px, jump_px, distances);
  return distances;
}

TEST(DepthJumpsTest, CountsColumnsFromBothSidesOfAJump) {
  EXPECT_EQ(Distances({5, 5, 5, 8, 8, 8, 8}), (std::vector<int>{3, 2, 1, 1, 2, 3, 4}));
  EXPECT_EQ(Distances({5, 5, 4, 4, 4, 5}), (std::vector<int>{2, 1, 1, 2, 1, 1}));
}

TEST(DepthJumpsTest, ARowWithoutAJumpIsFarFromOne) {
  for (const int distance : Distances({5, 5.5, 6.4, 7.3, 8.2})) EXPECT_GE(distance, kNoJump);
  EXPECT_GE(Distances({5}).front(), kNoJump);
  EXPECT_TRUE(Distances({}).empty());
}

TEST(DepthJumpsTest, AJumpIsExactlyAsLargeOrLarger) {
  EXPECT_EQ(Distances({5, 6})[0], 1);
  EXPECT_GE(Distances({5, 6}, 1.001)[0], kNoJump);
}

// Marks against distances, for every reach up to one beyond the row.
TEST(DepthJumpsTest, MarksWhatIsWithinReach) {
  std::vector<double> row_px;
  for (int i = 0; i < 60; ++i) row_px.push_back((i * i * 7 % 31) / 20.0);
  for (const double jump_px : {0.5, 1.0, 1.4, 9.0}) {
    const std::vector<int> distances = Distances(row_px, jump_px);
    std::vector<std::uint8_t> beside(row_px.size(), 1);
    for (std::int64_t reach = 0; reach <= 61; ++reach) {
      MarkJumps(row_px, jump_px, reach, beside);
      for (std::size_t i = 0; i < row_px.size(); ++i) {
        ASSERT_EQ(beside[i] != 0, distances[i] <= reach) << jump_px << ", " << reach << ", " << i;
      }
    }
  }
}

// Against the definition: the nearest of all jumps, looked for from every pixel.
TEST(DepthJumpsTest, IsTheNearestOfAllJumps) {
  std::vector<double> row_px;
  for (int i = 0; i < 60; ++i) row_px.push_back((i * i * 7 % 31) / 8.0);
  const std::vector<int> found = Distances(row_px);
  for (int i = 0; i < 60; ++i) {
    int nearest = kNoJump;
    for (int c = 1; c < 60; ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (std::abs(row_px[at] - row_px[at - 1]) < 1.0) continue;
      nearest = std::min(nearest, i >= c ? i - c + 1 : c - i);
    }
    EXPECT_EQ(std::min(found[static_cast<std::size_t>(i)], kNoJump), nearest) << i;
  }
}

// The other side of a jump begins where its distance says, on either hand.
TEST(DepthJumpsTest, FindsTheOtherSide) {
  const std::vector<double> row_px{5, 5, 5, 8, 8, 8, 3};
  const std::vector<int> distances = Distances(row_px);
  const std::vector<std::size_t> across{3, 3, 3, 2, 6, 6, 5};
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    EXPECT_EQ(AcrossJump(row_px, 1.0, column, distances[column]), across[column]) << column;
  }
}

}  // namespace
}  // namespace rockyard::sensing
