#include "experiments/cylinder_sighting/sighting_sums.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "math/angles.h"

namespace rockyard::experiments {
namespace {

constexpr double kWrongDeviations = 3.0;
constexpr double kWrongTurn_rad = math::DegToRad(10.0);
constexpr double kWrongShare = 0.10;

bool IsOff(double error, double deviation, double least) {
  return std::abs(error) > least && std::abs(error) > kWrongDeviations * deviation;
}

}  // namespace

void JudgeSighting(const CylinderTruth& truth, const vision::CylinderFinding& finding,
                   FinderSums& sums) {
  if (!finding.sighting) {
    sums.misses[static_cast<std::size_t>(finding.miss)] += 1.0;
    return;
  }
  const vision::CylinderSighting& seen = *finding.sighting;
  sums.found += 1.0;
  if (!truth.present) {
    sums.wrong += 1.0;
    return;
  }
  const double turn_rad = math::WrapAngle(seen.orientation_rad - truth.orientation_rad);
  const double true_range_m = truth.p_LT_L.head<2>().norm();
  const double range = seen.p_LT_L.head<2>().norm() / true_range_m - 1.0;
  const Eigen::Vector2d along = truth.p_LT_L.head<2>() / true_range_m;
  const double range_sd =
      std::sqrt(along.dot(seen.covariance.topLeftCorner<2, 2>() * along)) / true_range_m;
  sums.orientation_deg.Add(math::RadToDeg(turn_rad));
  sums.stereo.Add(seen.distance_by_stereo_m / truth.depth_m - 1.0);
  sums.size.Add(seen.distance_by_size_m / truth.depth_m - 1.0);
  if (IsOff(turn_rad, std::sqrt(seen.covariance(3, 3)), kWrongTurn_rad) ||
      IsOff(range, range_sd, kWrongShare)) {
    sums.wrong += 1.0;
    return;
  }
  sums.right += 1.0;
  sums.right_orientation_deg.Add(math::RadToDeg(turn_rad));
  sums.right_range.Add(range);
  const double bearing_rad = math::WrapAngle(std::atan2(seen.p_LT_L.y(), seen.p_LT_L.x()) -
                                             std::atan2(truth.p_LT_L.y(), truth.p_LT_L.x()));
  sums.right_bearing_mrad.Add(1e3 * bearing_rad);
  Eigen::Vector4d error;
  error << seen.p_LT_L - truth.p_LT_L, turn_rad;
  sums.nees += error.dot(seen.covariance.ldlt().solve(error));
}

}  // namespace rockyard::experiments
