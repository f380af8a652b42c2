#include "sensing/lander_fix.h"

#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/distributions.h"
#include "math/angles.h"
#include "math/polar.h"

namespace rockyard::sensing {

using messages::PoseCoordinate;

namespace {

// Far above the numbers of fixes.
constexpr std::uint32_t kChances = 1U << 31U;

}  // namespace

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

LanderFix::Outcome LanderFix::ByConstantLaw(const Draws& draws) const {
  return {.sd = {.heading_rad = params_.heading_sd_rad,
                 .range = params_.range_sd_fraction,
                 .bearing_rad = params_.bearing_sd_rad},
          .heading_rad = params_.heading_sd_rad * draws.heading,
          .range_factor = 1.0 + params_.range_sd_fraction * draws.range,
          .bearing_rad = params_.bearing_sd_rad * draws.bearing};
}

std::optional<LanderFix::Outcome> LanderFix::ByCylinderLaw(const CylinderStance& stance,
                                                           const Draws& draws,
                                                           std::int64_t number) const {
  const CylinderLawParams& cylinder = params_.cylinder;
  const CylinderLaw law(cylinder);
  core::RandomStream chances(key_, core::Purpose::kLanderFix,
                             kChances + static_cast<std::uint32_t>(number));
  if (!core::SampleBernoulli(chances, law.FindChance(stance))) return std::nullopt;
  Outcome outcome{.sd = law.Deviations(stance)};
  outcome.bearing_rad = outcome.sd.bearing_rad * draws.bearing;
  if (core::SampleBernoulli(chances, law.WrongChance(stance))) {
    outcome.heading_rad =
        core::SampleUniform(chances, -cylinder.wrong_turn_rad, cylinder.wrong_turn_rad);
    outcome.range_factor = std::exp(core::SampleNormal(chances, 0.0, cylinder.wrong_range));
    return outcome;
  }
  outcome.heading_rad = cylinder.heading_bias_rad + outcome.sd.heading_rad * draws.heading;
  outcome.range_factor = 1.0 + cylinder.range_bias + outcome.sd.range * draws.range;
  return outcome;
}

std::optional<messages::PoseFix> LanderFix::Observe(const math::Transform& X_WR,
                                                    const terrain::Terrain& terrain,
                                                    std::int64_t number,
                                                    std::optional<double> sun_elevation_rad) const {
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
  const double true_bearing_rad = std::atan2(dy_m, dx_m);
  std::optional<Outcome> outcome = ByConstantLaw(draws);
  if (params_.law == LanderFixLaw::kCylinder) {
    // The cameras stand opposite to the bearing, as seen from the rover.
    const double theta_rad = math::WrapAngle(true_bearing_rad + std::numbers::pi -
                                             math::Heading(X_WR) - params_.cylinder.mounting_rad);
    outcome = ByCylinderLaw(
        {true_range_m, theta_rad, sun_elevation_rad.value_or(params_.cylinder.sun_elevation_rad)},
        draws, number);
  }
  if (!outcome) return std::nullopt;
  const double range_m = true_range_m * outcome->range_factor;
  const double bearing_rad = true_bearing_rad + outcome->bearing_rad + lander_.pan_error_rad;
  messages::PoseFix fix;
  for (const auto coordinate : {PoseCoordinate::kX, PoseCoordinate::kY, PoseCoordinate::kHeading}) {
    fix.measured.set(static_cast<std::size_t>(messages::Index(coordinate)));
  }
  fix.pose_W[messages::Index(PoseCoordinate::kX)] = lander_.x_m + range_m * std::cos(bearing_rad);
  fix.pose_W[messages::Index(PoseCoordinate::kY)] = lander_.y_m + range_m * std::sin(bearing_rad);
  constexpr int kHeading = messages::Index(PoseCoordinate::kHeading);
  fix.pose_W[kHeading] =
      math::WrapAngle(math::Heading(X_WR) + outcome->heading_rad + lander_.pan_error_rad);
  fix.covariance.topLeftCorner<2, 2>() = math::PolarCovariance(
      bearing_rad, range_m * outcome->sd.range, range_m * outcome->sd.bearing_rad);
  fix.covariance(kHeading, kHeading) = outcome->sd.heading_rad * outcome->sd.heading_rad;
  return fix;
}

}  // namespace rockyard::sensing
