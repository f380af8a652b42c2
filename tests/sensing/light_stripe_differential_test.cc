// The sensor against the plain reference, in random rock fields and at random poses.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_scene.h"
#include "terrain/terrain.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using core::SampleUniform;

// The light stripe sensor once more, plain and slow: walks along the searched columns of a
// scanline, lays each column's viewing ray into the light plane, and asks point by point what is
// solid. Shares with the sensor only the calibration and the searched columns.
class ReferenceStripe {
 public:
  ReferenceStripe(const LightStripe& sensor, const LightStripeParams& params,
                  const terrain::Terrain& terrain, const math::Transform& X_WR)
      : sensor_(sensor), params_(params), terrain_(terrain), X_WR_(X_WR) {}

  messages::StripePixel Find(std::size_t row, std::size_t stripe) const {
    const auto& laser = sensor_.calibration().lasers[stripe];
    const auto& camera = sensor_.calibration().cameras[static_cast<std::size_t>(laser.camera)];
    const auto [first, last] = sensor_.searched(row, stripe);
    // Walk from the end near the emitter.
    const auto point = [&](double column) { return PlanePoint(row, stripe, column); };
    const auto gap = [&](double column) { return (point(column) - laser.p_RoE_R).norm(); };
    const bool forward = gap(first) < gap(last);
    const double begin = forward ? first - 0.5 : last + 0.5;
    const double step = forward ? 0.05 : -0.05;
    if (MeetsSolid(laser.p_RoE_R, point(begin), 0.0)) return {};
    for (double column = begin; column >= first - 0.5 && column <= last + 0.5; column += step) {
      const math::Vector3 p_R = point(column);
      if (!Solid(p_R)) continue;
      if ((p_R - camera.X_RC.translation()).norm() > params_.max_range_m) return {};
      if (MeetsSolid(camera.X_RC.translation(), p_R, 0.002)) return {};
      if (MeetsSolid(laser.p_RoE_R, p_R, 0.002)) return {};
      return {.detected = true, .column_px = std::round(column - 0.5 * step)};
    }
    return {};
  }

 private:
  math::Vector3 PlanePoint(std::size_t row, std::size_t stripe, double column) const {
    const auto& laser = sensor_.calibration().lasers[stripe];
    const auto& camera = sensor_.calibration().cameras[static_cast<std::size_t>(laser.camera)];
    const math::Vector3 ray =
        camera.X_RC.linear() *
        vision::PixelRay(camera,
                         {column, static_cast<double>(sensor_.calibration().scanline_px[row])});
    const math::Vector3 eye = camera.X_RC.translation();
    return eye + ray * laser.normal_R.dot(laser.p_RoE_R - eye) / laser.normal_R.dot(ray);
  }

  bool Solid(const math::Vector3& p_R) const {
    const math::Vector3 p = X_WR_ * p_R;
    if (p.z() <= terrain_.ground().Height(p.x(), p.y())) return true;
    for (const terrain::Rock& rock : terrain_.rocks()) {
      const math::Vector3 d = p - rock.center_W;
      const double along = std::cos(rock.yaw_rad) * d.x() + std::sin(rock.yaw_rad) * d.y();
      const double across = -std::sin(rock.yaw_rad) * d.x() + std::cos(rock.yaw_rad) * d.y();
      const math::Vector3 scaled(along / rock.semi_axes_m.x(), across / rock.semi_axes_m.y(),
                                 d.z() / rock.semi_axes_m.z());
      if (scaled.squaredNorm() <= 1.0) return true;
    }
    return false;
  }

  // True if anything solid lies between the points, all but the last `margin_m`.
  bool MeetsSolid(const math::Vector3& from_R, const math::Vector3& to_R, double margin_m) const {
    const double length = (to_R - from_R).norm() - margin_m;
    const math::Vector3 direction = (to_R - from_R).normalized();
    for (double s = 0.0; s < length; s += 0.0005) {
      if (Solid(from_R + s * direction)) return true;
    }
    return false;
  }

  const LightStripe& sensor_;
  const LightStripeParams& params_;
  const terrain::Terrain& terrain_;
  const math::Transform& X_WR_;
};

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
  terrain::GroundParams ground{.slope_rad = SampleUniform(stream, 0.0, 0.2),
                               .slope_direction_rad = SampleUniform(stream, -3.0, 3.0)};
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
