#include "rendering/picture/picture_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rockyard::rendering {

using math::Vector3;

PictureScene::PictureScene(const terrain::Terrain& terrain, const SunParams& sun,
                           const LookParams& look, double filter_width_m, const PlacedBody& rover)
    : terrain_(terrain),
      light_(MakeSunLight(sun, filter_width_m)),
      lommel_seeliger_share_(look.lommel_seeliger_share),
      rover_(rover),
      X_RW_(rover.X_WR.inverse()) {
  if (light_.direct_w_m2 > 0.0) {
    shadows_.emplace(terrain, light_.toward_sun_W, look.sun_diameter_rad, rover);
  }
}

bool PictureScene::MayBeIn(int rock, const Vector3& eye_W, double spread_m,
                           const RayCone& cone_W) const {
  const terrain::Rock& shape = terrain_.rocks()[static_cast<std::size_t>(rock)];
  const double reach_m = shape.semi_axes_m.maxCoeff() + spread_m + kRounding_m;
  return BallMeetsCone(shape.center_W - eye_W, reach_m, cone_W);
}

void PictureScene::RocksInCone(const Vector3& eye_W, double spread_m, const RayCone& cone_W,
                               std::vector<int>& out) const {
  out.clear();
  for (int rock = 0; rock < std::ssize(terrain_.rocks()); ++rock) {
    if (MayBeIn(rock, eye_W, spread_m, cone_W)) out.push_back(rock);
  }
}

void PictureScene::RocksInCone(const Vector3& eye_W, double spread_m, const RayCone& cone_W,
                               std::span<const int> among, std::vector<int>& out) const {
  out.clear();
  for (const int rock : among) {
    if (MayBeIn(rock, eye_W, spread_m, cone_W)) out.push_back(rock);
  }
}

Met PictureScene::Meet(const Vector3& origin_W, const Vector3& ray_W,
                       std::span<const int> rocks) const {
  Met met;
  double body_m = RoverBody::kFree;
  if (rover_.body != nullptr) {
    body_m = rover_.body->Distance(X_RW_ * origin_W, X_RW_.linear() * ray_W);
  }
  const auto hit = terrain_.CastRay(origin_W, ray_W, std::min(body_m, kFarthest_m), rocks,
                                    terrain::RayWay::kSpline);
  SurfacePoint& point = met.point;
  if (hit) {
    met.range_m = hit->distance_m;
    point.p_W = hit->point_W;
    point.normal_W = hit->normal_W;
    point.surface = hit->surface == terrain::Surface::kRock   ? hit->rock
                    : hit->surface == terrain::Surface::kWall ? SurfacePoint::kWall
                                                              : SurfacePoint::kGround;
  } else if (body_m < kFarthest_m) {
    met.range_m = body_m;
    point.p_W = origin_W + body_m * ray_W;
    point.normal_W =
        rover_.X_WR.linear() * rover_.body->Normal(X_RW_ * origin_W, X_RW_.linear() * ray_W);
    point.surface = SurfacePoint::kRover;
  } else {
    met.range_m = RoverBody::kFree;
    return met;
  }
  if (shadows_) met.sunlit = shadows_->Visible(point.p_W, point.normal_W, point.surface);
  return met;
}

bool PictureScene::Hides(const Vector3& p_W, const Vector3& eye_W) const {
  if (terrain_.Occluded(eye_W, p_W, kOcclusionMargin_m)) return true;
  if (rover_.body == nullptr) return false;
  const Vector3 away_W = p_W - eye_W;
  const double distance_m = away_W.norm();
  return rover_.body->Distance(X_RW_ * eye_W, X_RW_.linear() * away_W / distance_m) <
         distance_m - kOcclusionMargin_m;
}

double PictureScene::Radiance(const Met& met, const Vector3& ray_W, double albedo,
                              const Vector3& normal_W) const {
  // An even sky of irradiance E has the radiance E / pi in every direction.
  if (met.point.surface == SurfacePoint::kSky) return light_.sky_w_m2 * std::numbers::inv_pi;
  double radiance = SunRadiance(light_, albedo, normal_W, false);
  const double mu0 = normal_W.dot(light_.toward_sun_W);
  if (met.sunlit > 0.0 && mu0 > 0.0) {
    double factor = mu0;
    if (lommel_seeliger_share_ > 0.0) {
      const double mu = std::max(-normal_W.dot(ray_W), 0.0);
      factor += lommel_seeliger_share_ * (2.0 * mu0 / (mu0 + mu) - mu0);
    }
    radiance += albedo * std::numbers::inv_pi * light_.direct_w_m2 * met.sunlit * factor;
  }
  return radiance;
}

}  // namespace rockyard::rendering
