#include "sensing/sun_shade.h"

#include <cmath>

#include "rendering/occlusion.h"
#include "rendering/radiometry.h"
#include "sensing/rover_parts.h"

namespace rockyard::sensing {
namespace {

constexpr double kFarthestShade_m = 50.0;
// Width of a filter: the direction of the sun does not depend on it.
constexpr double kAnyWidth_m = 1e-9;

}  // namespace

SunShade::SunShade(const rendering::SunParams& sun, const rover::RoverGeometryParams& rover)
    : toward_sun_W_(rendering::MakeSunLight(sun, kAnyWidth_m).toward_sun_W),
      body_(MakeRoverBody(rover)) {}

bool SunShade::IsShaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                        const terrain::RayHit& hit) const {
  if (hit.normal_W.dot(toward_sun_W_) <= 0.0) return true;
  const auto nearest = terrain.CastRay(hit.point_W + rendering::kOcclusionMargin_m * toward_sun_W_,
                                       toward_sun_W_, kFarthestShade_m);
  if (nearest && nearest->surface != terrain::Surface::kWall) return true;
  const math::Transform X_RW = X_WR.inverse();
  return std::isfinite(body_.Distance(X_RW * hit.point_W, X_RW.linear() * toward_sun_W_));
}

}  // namespace rockyard::sensing
