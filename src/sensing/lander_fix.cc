#include "sensing/lander_fix.h"

#include <cmath>

#include "core/check.h"
#include "core/distributions.h"
#include "math/angles.h"
#include "math/polar.h"

namespace rockyard::sensing {

using messages::PoseCoordinate;

LanderFix::LanderFix(const LanderFixParams& params, const LanderPlace& lander, core::TrialKey key)
    : params_(params), lander_(lander), key_(key) {}

LanderFix::Draws LanderFix::Draw(std::uint32_t substream) const {
  core::RandomStream stream(key_, core::Purpose::kLanderFix, substream);
  Draws draws;
  draws.range = core::SampleNormal(stream, 0.0, 1.0);
  draws.bearing = core::SampleNormal(stream, 0.0, 1.0);
  draws.heading = core::SampleNormal(stream, 0.0, 1.0);
  return draws;
}

LanderFix::Draws LanderFix::DrawFix(std::int64_t number) const {
  const Draws common = Draw(0);
  const Draws own = Draw(static_cast<std::uint32_t>(number + 1));
  const double shared = std::sqrt(params_.common_share);
  const double anew = std::sqrt(1.0 - params_.common_share);
  return {shared * common.range + anew * own.range, shared * common.bearing + anew * own.bearing,
          shared * common.heading + anew * own.heading};
}

std::optional<messages::PoseFix> LanderFix::Observe(const math::Transform& X_WR,
                                                    const terrain::Terrain& terrain,
                                                    std::int64_t number) const {
  EXPECT(number >= 0);
  const math::Vector3 p_WoRo_W = X_WR.translation();
  const double dx_m = p_WoRo_W.x() - lander_.x_m;
  const double dy_m = p_WoRo_W.y() - lander_.y_m;
  const double true_range_m = std::hypot(dx_m, dy_m);
  if (true_range_m > params_.range_m) return std::nullopt;
  const math::Vector3 mast_W(
      lander_.x_m, lander_.y_m,
      terrain.ground().Height(lander_.x_m, lander_.y_m) + params_.mast_height_m);
  const math::Vector3 top_W = p_WoRo_W + params_.rover_height_m * math::Vector3::UnitZ();
  constexpr double kMargin_m = 0.01;
  if (terrain.Occluded(mast_W, top_W, kMargin_m)) return std::nullopt;

  const Draws draws = DrawFix(number);
  const double range_m = true_range_m * (1.0 + params_.range_sd_fraction * draws.range);
  const double bearing_rad =
      std::atan2(dy_m, dx_m) + params_.bearing_sd_rad * draws.bearing + lander_.pan_error_rad;
  messages::PoseFix fix;
  for (const auto coordinate : {PoseCoordinate::kX, PoseCoordinate::kY, PoseCoordinate::kHeading}) {
    fix.measured.set(static_cast<std::size_t>(messages::Index(coordinate)));
  }
  fix.pose_W[messages::Index(PoseCoordinate::kX)] = lander_.x_m + range_m * std::cos(bearing_rad);
  fix.pose_W[messages::Index(PoseCoordinate::kY)] = lander_.y_m + range_m * std::sin(bearing_rad);
  constexpr int kHeading = messages::Index(PoseCoordinate::kHeading);
  fix.pose_W[kHeading] = math::WrapAngle(
      math::Heading(X_WR) + params_.heading_sd_rad * draws.heading + lander_.pan_error_rad);
  fix.covariance.topLeftCorner<2, 2>() = math::PolarCovariance(
      bearing_rad, range_m * params_.range_sd_fraction, range_m * params_.bearing_sd_rad);
  fix.covariance(kHeading, kHeading) = params_.heading_sd_rad * params_.heading_sd_rad;
  return fix;
}

}  // namespace rockyard::sensing
