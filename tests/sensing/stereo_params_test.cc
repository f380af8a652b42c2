// What users may ask of the stereo cameras, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/archive.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/params_text.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

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

}  // namespace
}  // namespace rockyard::sensing
