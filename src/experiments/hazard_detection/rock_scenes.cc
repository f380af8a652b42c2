#include "experiments/hazard_detection/rock_scenes.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "terrain/rock.h"

namespace rockyard::experiments {

using math::Vector3;

terrain::Rock DrawSceneRock(const RockCell& cell, RockProportions proportions,
                            const terrain::RockFieldParams& law, double lateral_m,
                            core::RandomStream& stream) {
  const double width_ratio = core::SampleUniform(stream, law.min_width_ratio, law.max_width_ratio);
  const double height_ratio =
      core::SampleUniform(stream, law.min_height_ratio, law.max_height_ratio);
  const double buried = core::SampleUniform(stream, law.burial_mean - law.burial_spread,
                                            law.burial_mean + law.burial_spread);
  const double c_m = 0.5 * cell.height_m / (1.0 - buried);
  const bool natural = proportions == RockProportions::kNatural;
  const terrain::RockOutline outline{
      .diameter_m = natural ? 2.0 * c_m / height_ratio : cell.diameter_m,
      .width_ratio = width_ratio,
      .half_height_m = c_m,
      .height_m = cell.height_m};
  terrain::Rock rock = terrain::ShapeRock(outline, law.pointedness);
  // An ellipse looks the same after half a turn.
  rock.yaw_rad = core::SampleUniform(stream, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  rock.center_W.head<2>() << rock.semi_axes_m.x(), lateral_m;
  return rock;
}

terrain::Terrain SceneTerrain(const terrain::Rock& rock) {
  std::vector<terrain::Rock> rocks;
  if (rock.height_m > 0.0) rocks.push_back(rock);
  return {terrain::Ground(), std::move(rocks), {}};
}

math::Transform PoseBefore(double gap_m, double heading_rad, double front_x_m) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 front_W(-gap_m, -gap_m * std::tan(heading_rad), 0.0);
  X_WR.translation() = front_W - X_WR.linear() * Vector3(front_x_m, 0.0, 0.0);
  return X_WR;
}

}  // namespace rockyard::experiments
