// The sensor against the plain reference, in random rock fields and at random poses.
#include <gtest/gtest.h>

#include <cmath>

#include "core/distributions.h"
#include "sensing/light_stripe_reference.h"
#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

using core::SampleUniform;

// Every other scene has rough ground.
terrain::Terrain RandomScene(core::RandomStream& stream, int scene) {
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 6; ++i) {
    const double a = SampleUniform(stream, 0.03, 0.15);
    const double x = SampleUniform(stream, 0.40, 0.80);
    const double y = SampleUniform(stream, -0.5, 0.5);
    const double c = a * SampleUniform(stream, 0.4, 1.0);
    const double z = c * SampleUniform(stream, -0.5, 0.4);
    const double b = a * SampleUniform(stream, 0.6, 1.0);
    rocks.push_back(EllipsoidRock(x, y, z, a, b, c, SampleUniform(stream, 0.0, 3.1)));
  }
  terrain::GroundParams ground;
  ground.slope_rad = SampleUniform(stream, 0.0, 0.2);
  ground.slope_direction_rad = SampleUniform(stream, -3.0, 3.0);
  if (scene % 2 == 1) ground.roughness_rms_m = 0.02;
  return {terrain::Ground(ground, {1, static_cast<std::uint32_t>(scene)}), std::move(rocks), {}};
}

math::Transform RandomPose(core::RandomStream& stream) {
  math::Transform X_WR = PoseAt(SampleUniform(stream, -0.1, 0.1), SampleUniform(stream, -0.1, 0.1),
                                SampleUniform(stream, 0.0, 0.05), SampleUniform(stream, -0.2, 0.2));
  X_WR.rotate(Eigen::AngleAxisd(SampleUniform(stream, -0.15, 0.15), math::Vector3::UnitY()));
  X_WR.rotate(Eigen::AngleAxisd(SampleUniform(stream, -0.15, 0.15), math::Vector3::UnitX()));
  return X_WR;
}

struct Tally {
  int points = 0;
  int found = 0;
  int missing = 0;
  int detection_differs = 0;
  int column_differs = 0;  // by more than a pixel
};

Tally Compare(const LightStripeParams& params, int scenes) {
  const LightStripe sensor(params);
  Tally tally;
  for (int scene = 0; scene < scenes; ++scene) {
    core::RandomStream stream({20260102, 0}, core::Purpose::kTest,
                              static_cast<std::uint32_t>(scene));
    const terrain::Terrain terrain = RandomScene(stream, scene);
    const math::Transform X_WR = RandomPose(stream);
    const auto scan = sensor.Scan(terrain, X_WR, {1, 0}, scene);
    const ReferenceStripe reference(sensor, params, terrain, X_WR);
    for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
      for (std::size_t stripe = 0; stripe < messages::kStripes; ++stripe) {
        const auto expected = reference.Find(row, stripe);
        const auto& actual = scan.pixels[row][stripe];
        ++tally.points;
        tally.found += expected.detected;
        tally.missing += !expected.detected;
        if (actual.detected != expected.detected) {
          ++tally.detection_differs;
        } else if (std::abs(actual.column_px - expected.column_px) > 1.0) {
          ++tally.column_differs;
        }
      }
    }
  }
  return tally;
}

class LightStripeDifferentialTest : public testing::TestWithParam<messages::Lens> {};

TEST_P(LightStripeDifferentialTest, AgreesWithThePlainReference) {
  LightStripeParams params = NoiselessParams();
  params.lens = GetParam();
  const Tally tally = Compare(params, 60);
  EXPECT_GT(tally.found, tally.points / 2);
  EXPECT_GT(tally.missing, 20);
  // Both decide by sampling or by margins where a line of sight grazes a rock.
  EXPECT_LE(tally.detection_differs, tally.points / 200);
  EXPECT_LE(tally.column_differs, tally.points / 200);
}

INSTANTIATE_TEST_SUITE_P(Lenses, LightStripeDifferentialTest,
                         testing::Values(messages::Lens::kEquidistantRows,
                                         messages::Lens::kEquidistant, messages::Lens::kPinhole));

TEST(LightStripeReferenceTest, TellsASensorThatIgnoresItsRange) {
  // Negative control: the comparison notices a small difference in what is visible.
  LightStripeParams reference_params = NoiselessParams();
  const LightStripe sensor(reference_params);
  reference_params.max_range_m = 0.42;
  int differs = 0;
  const terrain::Terrain flat = FlatWith({});
  const math::Transform X_WR = PoseAt(0, 0, 0);
  const auto scan = sensor.Scan(flat, X_WR, {1, 0}, 0);
  const ReferenceStripe reference(sensor, reference_params, flat, X_WR);
  for (std::size_t stripe = 0; stripe < messages::kStripes; ++stripe) {
    differs += scan.pixels[3][stripe].detected != reference.Find(3, stripe).detected;
  }
  EXPECT_EQ(differs, 5);
}

}  // namespace
}  // namespace rockyard::sensing
