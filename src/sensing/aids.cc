#include "sensing/aids.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"
#include "math/polar.h"
#include "vision/cylinder/colour_cylinder.h"
#include "vision/cylinder/cylinder_equations.h"

namespace rockyard::sensing {
namespace {

using messages::PoseCoordinate;

constexpr double kQuadrant_rad = 0.5 * std::numbers::pi;
// Part of the fit in aid_params.h: intercepts are log odds at this width.
constexpr double kWidthOfIntercept_px = 20.0;

bool ShowsNoBlue(double theta_rad) {
  const double theta = math::WrapAngle(theta_rad);
  return theta > -std::numbers::pi && theta < -kQuadrant_rad;
}

double ToNearestBoundary_rad(double theta_rad) {
  return std::abs(std::remainder(theta_rad, kQuadrant_rad));
}

double RootSum(const CylinderDeviationParams& deviation, double step) {
  return math::Hypot(deviation.least, deviation.pixels * step);
}

// First substream of the chances, far above the numbers of fixes. Records depend on it.
constexpr std::uint32_t kChances = 1U << 31U;

constexpr double kSensorHeight_m = 0.3;  // on top of the rover (Matthies 1995 sec. 2.1.2)
constexpr double kShadowReach_m = 30.0;  // a rock of 0.5 m shades it at 1 deg
constexpr double kLowestSun_rad = math::DegToRad(1.0);

}  // namespace

double CylinderLaw::Width_px(double distance_m) const {
  const vision::ViewOfCylinder view{.image_width_px = params_.image_width_px,
                                    .field_of_view_rad = params_.field_of_view_rad,
                                    .radius_m = 0.5 * vision::ColourCylinder{}.diameter_m};
  return 2.0 / vision::FinestTurnAt(view, distance_m);
}

double CylinderLaw::Chance(const CylinderChanceParams& chance, const CylinderStance& stance) const {
  const double odds = chance.intercept +
                      chance.width * math::Log(Width_px(stance.distance_m) / kWidthOfIntercept_px) +
                      (ShowsNoBlue(stance.theta_rad) ? chance.no_blue : 0.0) +
                      chance.pink_aside * math::Sin(2.0 * stance.theta_rad) +
                      chance.light * math::Sin(stance.sun_elevation_rad);
  return 1.0 / (1.0 + math::Exp(-odds));
}

double CylinderLaw::FindChance(const CylinderStance& stance) const {
  if (stance.distance_m < params_.nearest_m || stance.sun_elevation_rad <= 0.0) return 0.0;
  return Chance(params_.found, stance);
}

double CylinderLaw::WrongChance(const CylinderStance& stance) const {
  return Chance(params_.wrong, stance);
}

CylinderDeviations CylinderLaw::Deviations(const CylinderStance& stance) const {
  const double m_px = Width_px(stance.distance_m);
  const double turn_step = 2.0 / (m_px * math::Cos(ToNearestBoundary_rad(stance.theta_rad)));
  const double pixel_rad =
      2.0 * math::Tan(0.5 * params_.field_of_view_rad) / params_.image_width_px;
  return {.heading_rad = RootSum(params_.heading, turn_step),
          .range = RootSum(params_.range, 1.0 / m_px),
          .bearing_rad = RootSum(params_.bearing, pixel_rad)};
}

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
    outcome.range_factor = math::Exp(core::SampleNormal(chances, 0.0, cylinder.wrong_range));
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
  const double true_range_m = math::Hypot(dx_m, dy_m);
  if (true_range_m > params_.range_m) return std::nullopt;
  const math::Vector3 mast_W(
      lander_.x_m, lander_.y_m,
      terrain.ground().Height(lander_.x_m, lander_.y_m) + params_.mast_height_m);
  const math::Vector3 top_W = p_WoRo_W + params_.rover_height_m * math::Vector3::UnitZ();
  constexpr double kMargin_m = 0.01;
  if (terrain.Occluded(mast_W, top_W, kMargin_m)) return std::nullopt;

  const Draws draws = DrawFix(number);
  const double true_bearing_rad = math::Atan2(dy_m, dx_m);
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
  fix.in_lander_frame = params_.shares_pan_error;
  for (const auto coordinate : {PoseCoordinate::kX, PoseCoordinate::kY, PoseCoordinate::kHeading}) {
    fix.measured.set(static_cast<std::size_t>(messages::Index(coordinate)));
  }
  fix.pose[messages::Index(PoseCoordinate::kX)] = lander_.x_m + range_m * math::Cos(bearing_rad);
  fix.pose[messages::Index(PoseCoordinate::kY)] = lander_.y_m + range_m * math::Sin(bearing_rad);
  constexpr int kHeading = messages::Index(PoseCoordinate::kHeading);
  fix.pose[kHeading] =
      math::WrapAngle(math::Heading(X_WR) + outcome->heading_rad + lander_.pan_error_rad);
  fix.covariance.topLeftCorner<2, 2>() = math::PolarCovariance(
      bearing_rad, range_m * outcome->sd.range, range_m * outcome->sd.bearing_rad);
  fix.covariance(kHeading, kHeading) = outcome->sd.heading_rad * outcome->sd.heading_rad;
  return fix;
}

double SunSensor::DirectionSd_rad(double sine_of_elevation) const {
  EXPECT(sine_of_elevation > 0.0);
  return params_.noise_sd_rad *
         math::Exp(0.5 * params_.optical_depth * (1.0 / sine_of_elevation - 1.0));
}

std::optional<messages::SunSighting> SunSensor::Observe(const math::Transform& X_WR,
                                                        const math::Vector3& sun_W,
                                                        const terrain::Terrain& terrain,
                                                        std::int64_t number) const {
  EXPECT(number >= 0);
  if (sun_W.z() < math::Sin(kLowestSun_rad)) return std::nullopt;
  const math::Vector3 sun_R = X_WR.linear().transpose() * sun_W;
  if (sun_R.z() < math::Cos(params_.half_field_of_view_rad)) return std::nullopt;
  const math::Vector3 eye_W = X_WR * math::Vector3(0.0, 0.0, kSensorHeight_m);
  if (terrain.CastRay(eye_W, sun_W, kShadowReach_m)) return std::nullopt;
  core::RandomStream stream(key_, core::Purpose::kSunSensor, static_cast<std::uint32_t>(number));
  if (core::SampleBernoulli(stream, params_.dropout_probability)) return std::nullopt;
  messages::SunSighting sighting;
  sighting.direction_sd_rad = DirectionSd_rad(sun_W.z());
  const double first = core::SampleNormal(stream, 0.0, sighting.direction_sd_rad);
  const double second = core::SampleNormal(stream, 0.0, sighting.direction_sd_rad);
  const math::Vector3 across = sun_R.unitOrthogonal();
  sighting.sun_R = (sun_R + first * across + second * sun_R.cross(across)).normalized();
  return sighting;
}

std::optional<messages::BeaconReading> RadioBeacon::Observe(const math::Transform& X_WR,
                                                            std::int64_t number) const {
  EXPECT(number >= 0);
  const double dx_m = X_WR.translation().x() - station_.x_m;
  const double dy_m = X_WR.translation().y() - station_.y_m;
  const double range_m = math::Hypot(dx_m, dy_m);
  if (range_m > params_.range_m) return std::nullopt;
  core::RandomStream stream(key_, core::Purpose::kRadioBeacon, static_cast<std::uint32_t>(number));
  const double range_error_m = core::SampleNormal(stream, 0.0, params_.range_sd_m);
  const double bearing_error_rad = core::SampleNormal(stream, 0.0, params_.bearing_sd_rad);
  return messages::BeaconReading{
      .station_x_m = station_.x_m,
      .station_y_m = station_.y_m,
      .range_m = std::max(0.0, range_m + range_error_m),
      .bearing_rad = math::WrapAngle(math::Atan2(dy_m, dx_m) + bearing_error_rad),
      .range_sd_m = params_.range_sd_m,
      .bearing_sd_rad = params_.bearing_sd_rad};
}

}  // namespace rockyard::sensing
