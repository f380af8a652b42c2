#include "stripe_levels.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/random.h"
#include "terrain/field.h"
#include "trial/course/layout.h"

namespace rockyard::trial {
namespace {

using math::Vector3;
using scenario::Scenario;

bool StandsFree(const terrain::Terrain& terrain, const Vector3& p_W) {
  constexpr double kHighest_m = 0.10;
  constexpr double kRoom_m = 0.45;
  std::vector<int> near;
  terrain.RocksNear(p_W.x(), p_W.y(), kRoom_m, near);
  for (const int index : near) {
    const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
    const double away_m = (rock.center_W - p_W).head<2>().norm() - rock.semi_axes_m.x();
    if (rock.height_m > kHighest_m && away_m < kRoom_m) return false;
  }
  return true;
}

math::Transform RandomPose(core::RandomStream& stream) {
  math::Transform X_WR = math::Transform::Identity();
  const double x_m = core::SampleUniform(stream, 0.8, 7.0);
  const double y_m = core::SampleUniform(stream, -0.6, 0.6);
  X_WR.translation() = Vector3(x_m, y_m, 0.0);
  const double heading_rad = core::SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, Vector3::UnitZ()).toRotationMatrix();
  return X_WR;
}

sensing::LightStripeParams WithoutErrors(sensing::LightStripeParams params) {
  params.wrong_place_probability = 0.0;
  params.missed_probability = 0.0;
  params.missed_at.clear();
  params.column_noise_px = 0.0;
  return params;
}

Scenario AtLevel(Scenario scenario, sensing::Fidelity fidelity) {
  scenario.drive.sensors.light_stripe.fidelity = fidelity;
  return scenario;
}

}  // namespace

StripeScene MakeStripeScene(const Scenario& scenario, SceneKind kind, std::uint32_t index) {
  core::TrialKey key{static_cast<std::uint64_t>(scenario.seed), index};
  constexpr int kTries = 1000;
  constexpr std::uint32_t kNextField = 1000000;
  for (;; key.trial += kNextField) {
    terrain::Terrain terrain =
        kind == SceneKind::kFlat
            ? terrain::Terrain(terrain::Ground(), {}, {})
            : terrain::BuildField(scenario.drive.terrain, key, TerrainCourse(scenario.drive.course))
                  .terrain;
    core::RandomStream stream(key, core::Purpose::kTest);
    for (int i = 0; i < kTries; ++i) {
      const math::Transform X_WR = RandomPose(stream);
      if (StandsFree(terrain, X_WR.translation())) return {std::move(terrain), X_WR, key};
    }
  }
}

double PointTally::offset_deviation_px() const {
  const double mean = offset_mean_px();
  return std::sqrt(offset_squares_px2 / static_cast<double>(right()) - mean * mean);
}

void PointTally::Add(const messages::StripeScan& truth, const messages::StripeScan& found) {
  const auto expected = truth.pixels.points();
  const auto actual = found.pixels.points();
  if (visible + hidden == 0) {
    visible_at = messages::StripeArray<std::int64_t>(truth.pixels.size());
    missed_at = visible_at;
  }
  for (std::size_t point = 0; point < expected.size(); ++point) {
    if (!expected[point].detected) {
      ++hidden;
      ghosts += actual[point].detected;
      continue;
    }
    ++visible;
    ++visible_at.points()[point];
    const double offset_px = actual[point].column_px - expected[point].column_px;
    if (!actual[point].detected) {
      ++missed;
      ++missed_at.points()[point];
    } else if (std::abs(offset_px) > kRight_px) {
      ++misplaced;
    } else {
      offset_sum_px += offset_px;
      offset_squares_px2 += offset_px * offset_px;
      ++offsets[static_cast<std::size_t>(std::lround(offset_px) + kRight_px)];
    }
  }
}

LevelOfStripes::LevelOfStripes(Scenario scenario, sensing::Fidelity fidelity)
    : scanner_(AtLevel(std::move(scenario), fidelity).drive) {}

PointTally TallyPoints(const Scenario& scenario, sensing::Fidelity fidelity, SceneKind kind,
                       std::uint32_t scenes) {
  const LevelOfStripes level(scenario, fidelity);
  const sensing::LightStripe geometry(WithoutErrors(scenario.drive.sensors.light_stripe));
  PointTally tally;
  for (std::uint32_t index = 0; index < scenes; ++index) {
    const StripeScene scene = MakeStripeScene(scenario, kind, index);
    tally.Add(geometry.Scan(scene.terrain, scene.X_WR, scene.key, 0), level.Scan(scene));
  }
  return tally;
}

}  // namespace rockyard::trial
