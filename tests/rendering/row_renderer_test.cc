// Lines of pictures of simple scenes, in sunlight and in the light of a lamp.
#include "rendering/row_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/line_kit.h"
#include "rendering/quiet_imager.h"
#include "terrain/placed_rocks.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr int kColumns = 96;
constexpr double kPixel_m2 = 1.4e-10;
constexpr double kWavelength_m = 850e-9;

// One lamp that lights everything alike: a surface sends back its albedo.
class EvenLamp final : public Lamps {
 public:
  void Add(const SurfacePoint& left, const SurfacePoint& right, int pixel, double gain,
           RenderedRow& row) const override {
    const auto radiance = [](const SurfacePoint& point) {
      return point.TakesLampLight() ? point.albedo : 0.0;
    };
    row.lamps.push_back({pixel, 0, 0.5 * gain * (radiance(left) + radiance(right))});
  }
};

// A pinhole 1 m above the ground, 1 m ahead of the rover, that looks straight down on 1 m of it.
messages::Camera CameraAbove() {
  messages::Camera camera{.lens = messages::Lens::kPinhole};
  camera.X_RC.translation() = Vector3(1.0, 0.0, 1.0);
  camera.X_RC.linear() =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitY()).toRotationMatrix();
  camera.column_pitch_rad = 1.0 / kColumns;
  camera.row_pitch_rad = camera.column_pitch_rad;
  camera.columns = kColumns;
  camera.rows = kColumns;
  return camera;
}

// Its middle line, with the rover at the origin.
struct Line {
  messages::Camera camera = CameraAbove();
  RoverBody body = SmallBody();
  SunParams sun;
  ImagerParams imager = QuietImager();

  ViewRow View() const { return MakeViewRow(camera, body, 0, -kColumns / 2, kColumns); }
  SunLight Light() const { return MakeSunLight(sun, imager.filter_width_m); }
  RenderedRow Render(const terrain::Terrain& terrain) const {
    const ImageScene scene(terrain, math::Transform::Identity(), Light(), sun, body, 4.0);
    return RowRenderer(imager, kPixel_m2, kWavelength_m)
        .Render(scene, EvenLamp(), camera.X_RC.translation(), View());
  }
};

TEST(RowRenderer, LevelGroundIsAsBrightAsTheSunMakesIt) {
  const Line line;
  const RenderedRow row = line.Render(terrain::FlatWith({}));
  const ViewRow view = line.View();
  const double electrons = ElectronsPerRadiance(line.imager, kPixel_m2, kWavelength_m);
  const double radiance = SunRadiance(line.Light(), line.sun.ground_albedo, Vector3::UnitZ(), true);
  const auto lamp = LampRates(row, 0);
  ASSERT_EQ(row.sun_e_s.size(), std::size_t{kColumns});
  for (std::size_t i = 0; i < row.sun_e_s.size(); ++i) {
    EXPECT_NEAR(row.sun_e_s[i] / (view.gain[i] * electrons * radiance), 1.0, 1e-12) << i;
    EXPECT_NEAR(lamp[i] / (view.gain[i] * electrons * line.sun.ground_albedo), 1.0, 1e-12) << i;
  }
}

// A ball of 20 cm under the camera: its outline is seen where the ray touches it, at the slope
// r / sqrt(h^2 - r^2), and cuts a pixel into parts.
TEST(RowRenderer, PixelsAreSplitWhereASurfaceEnds) {
  constexpr double kRadius = 0.2;
  const Line line;
  const RenderedRow row = line.Render(
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, kRadius, kRadius, kRadius)}));
  const ViewRow view = line.View();
  const double electrons = ElectronsPerRadiance(line.imager, kPixel_m2, kWavelength_m);
  const double edge_px = kRadius / std::sqrt(1.0 - kRadius * kRadius) * kColumns;
  const auto lamp = LampRates(row, 0);
  for (std::size_t i = 0; i < lamp.size(); ++i) {
    const double column_px = view.first_column + static_cast<double>(i);
    // Share of the pixel on the ball; its parts tell it to one of them.
    const double on_ball = std::clamp(edge_px - std::abs(column_px) + 0.5, 0.0, 1.0);
    const double albedo = on_ball * line.sun.rock_albedo + (1.0 - on_ball) * line.sun.ground_albedo;
    const double coarse = on_ball > 0.0 && on_ball < 1.0 ? 1.0 / RowRenderer::kParts : 1e-12;
    EXPECT_NEAR(lamp[i] / (view.gain[i] * electrons), albedo, coarse * 0.15 + 1e-12) << i;
  }
  // Every pixel has one term, those with the two edges one for each part.
  EXPECT_EQ(row.lamps.size(), std::size_t{kColumns + 2 * (RowRenderer::kParts - 1)});
}

// Under a rover that stands where the camera looks there is its own part, without a lamp's light.
TEST(RowRenderer, TheRoverItselfTakesNoLightOfLamps) {
  Line line;
  line.camera.X_RC.translation() = Vector3(0.0, 0.0, 1.0);
  const RenderedRow row = line.Render(terrain::FlatWith({}));
  const auto lamp = LampRates(row, 0);
  EXPECT_EQ(lamp[kColumns / 2], 0.0);
  EXPECT_GT(row.sun_e_s[kColumns / 2], 0.0);
  EXPECT_GT(lamp[0], 0.0);
}

// What the lens blurs it blurs of both lights, which change at the edge of the rock.
TEST(RowRenderer, BlursSunAndLamps) {
  Line line;
  const terrain::Terrain terrain =
      terrain::FlatWith({terrain::EllipsoidRock(1.0, 0.0, 0.0, 0.2, 0.2, 0.2)});
  const RenderedRow sharp = line.Render(terrain);
  line.imager.blur_px = 1.0;
  RenderedRow blurred = sharp;
  ImageBlur(1.0).Apply(blurred);
  const RenderedRow row = line.Render(terrain);
  EXPECT_EQ(row.sun_e_s, blurred.sun_e_s);
  EXPECT_EQ(LampRates(row, 0), LampRates(blurred, 0));
  EXPECT_NE(row.sun_e_s, sharp.sun_e_s);
}

}  // namespace
}  // namespace rockyard::rendering
