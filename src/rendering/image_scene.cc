#include "rendering/image_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rendering/occlusion.h"

namespace rockyard::rendering {

namespace {

using math::Vector3;

// Rays end here: far ground shows no detail.
constexpr double kFarthest_m = 100.0;
// Rough ground further than this towards the sun casts no shadow. Must equal kGroundShadowReach_m
// of picture/sun_shadows.cc.
constexpr double kGroundShadow_m = 2.0;

double Reach(const terrain::Rock& rock) { return rock.semi_axes_m.maxCoeff() + kRounding_m; }

// Returns whether a ball may come between another ball and the sun. `from_ball` leads from the
// centre of the other ball to its own, reach_m is the sum of both radii.
bool ComesBetween(const Vector3& from_ball, const Vector3& toward_sun, double reach_m) {
  // Two balls' shadows overlap where their centres, seen along the sun's rays, are nearer than both
  // radii: |r|^2 - (r . s)^2 <= reach^2.
  const double along = from_ball.dot(toward_sun);
  if (along < -reach_m) return false;
  return from_ball.squaredNorm() - along * along <= reach_m * reach_m;
}

}  // namespace

ImageScene::ImageScene(const terrain::Terrain& terrain, const math::Transform& X_WR,
                       const SunLight& light, const SunParams& sun, const RoverBody& body,
                       double sight_m)
    : terrain_(terrain),
      body_(body),
      sight_m_(sight_m),
      X_WR_(X_WR),
      X_RW_(X_WR.inverse()),
      light_(light),
      sun_(sun),
      toward_sun_R_(X_RW_.linear() * light.toward_sun_W),
      body_center_W_(X_WR * body.center_R()) {
  const Vector3 origin_W = X_WR.translation();
  terrain.RocksNear(origin_W.x(), origin_W.y(), sight_m_, near_);
  // Without direct light nothing casts a shadow.
  if (light.direct_w_m2 <= 0.0) return;
  const auto rocks = terrain.rocks();
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const Vector3 away = rocks[i].center_W - origin_W;
    if (!ComesBetween(away, light.toward_sun_W, sight_m_ + Reach(rocks[i]))) continue;
    before_sun_.push_back(static_cast<int>(i));
    shapes_.emplace_back(rocks[i]);
  }
}

void ImageScene::RocksNearPlane(const Vector3& eye_W, const Vector3& normal_W, double sine,
                                std::vector<int>& out) const {
  out.clear();
  for (const int index : near_) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    const Vector3 away = rock.center_W - eye_W;
    const double reach_m = Reach(rock);
    // A ball of that reach meets |n . r| <= sine |r| if its centre is within reach of it; |r| is at
    // most |away| + reach.
    const double off_m = std::abs(normal_W.dot(away));
    if (off_m <= reach_m + sine * (away.norm() + reach_m)) out.push_back(index);
  }
}

void ImageScene::RocksInCone(const Vector3& eye_W, const Vector3& axis_W, double half_sine,
                             double half_cosine, std::span<const int> among,
                             std::vector<int>& out) const {
  const RayCone cone{axis_W, half_sine, half_cosine};
  out.clear();
  for (const int index : among) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    if (BallMeetsCone(rock.center_W - eye_W, Reach(rock), cone)) out.push_back(index);
  }
}

void ImageScene::RocksInSheet(const Vector3& p_W, const Vector3& normal_W, double width_m,
                              std::vector<int>& out) const {
  out.clear();
  for (const int index : near_) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    // The sheet lies between two parallel planes: the distance of the centre against both widths.
    if (std::abs(normal_W.dot(rock.center_W - p_W)) <= width_m + Reach(rock)) out.push_back(index);
  }
}

void ImageScene::RocksBeforeSun(const Ball& ball, std::vector<int>& out) const {
  std::vector<int> all(before_sun_.size());
  std::iota(all.begin(), all.end(), 0);
  RocksBeforeSun(ball, all, out);
}

void ImageScene::RocksBeforeSun(const Ball& ball, std::span<const int> among,
                                std::vector<int>& out) const {
  out.clear();
  for (const int i : among) {
    const auto index = static_cast<std::size_t>(before_sun_[static_cast<std::size_t>(i)]);
    const terrain::Rock& rock = terrain_.rocks()[index];
    // ComesBetween looks at both balls along the sun's rays.
    const double reach_m = ball.radius_m + Reach(rock);
    if (ComesBetween(rock.center_W - ball.center_W, light_.toward_sun_W, reach_m)) {
      out.push_back(i);
    }
  }
}

// Returns the point at body_m along the ray, on the rover's own part.
SurfacePoint ImageScene::MeetRover(const Vector3& eye_W, const Vector3& ray_W,
                                   double body_m) const {
  SurfacePoint point;
  point.surface = SurfacePoint::kRover;
  point.p_W = eye_W + body_m * ray_W;
  point.normal_W = X_WR_.linear() * body_.Normal(X_RW_ * eye_W, X_RW_.linear() * ray_W);
  point.albedo = sun_.rover_albedo;
  return point;
}

SurfacePoint ImageScene::Meet(const Vector3& eye_W, const Vector3& ray_W, double body_m,
                              std::span<const int> rocks) const {
  const double farthest_m = std::min(body_m, kFarthest_m);
  const auto hit = terrain_.CastRay(eye_W, ray_W, farthest_m, rocks);
  if (!hit) return body_m < kFarthest_m ? MeetRover(eye_W, ray_W, body_m) : SurfacePoint{};
  SurfacePoint point;
  point.p_W = hit->point_W;
  point.normal_W = hit->normal_W;
  switch (hit->surface) {
    case terrain::Surface::kGround:
      point.surface = SurfacePoint::kGround;
      break;
    case terrain::Surface::kWall:
      point.surface = SurfacePoint::kWall;
      break;
    case terrain::Surface::kRock:
      point.surface = hit->rock;
      break;
  }
  // Walls are as bright as rocks.
  const bool is_ground = hit->surface == terrain::Surface::kGround;
  point.albedo = is_ground ? sun_.ground_albedo : sun_.rock_albedo;
  return point;
}

bool ImageScene::InRoversShadow(const Vector3& p_W) const {
  if (!ComesBetween(body_center_W_ - p_W, light_.toward_sun_W, body_.radius_m())) return false;
  return body_.Distance(X_RW_ * p_W, toward_sun_R_) < RoverBody::kFree;
}

bool ImageScene::Sunlit(const SurfacePoint& point, std::span<const int> shading) const {
  // A surface turned away from the sun shades itself.
  if (point.normal_W.dot(light_.toward_sun_W) <= 0.0) return false;
  for (const int i : shading) {
    // A rock is convex: where it faces the sun it does not shade itself.
    if (before_sun_[static_cast<std::size_t>(i)] == point.surface) continue;
    const terrain::RockShape& shape = shapes_[static_cast<std::size_t>(i)];
    if (shape.Distance(point.p_W, light_.toward_sun_W) < terrain::RockShape::kNoHit) return false;
  }
  if (InRoversShadow(point.p_W)) return false;
  if (terrain_.ground().IsPlane()) return true;
  // Off the surface by the margin, so that the march does not meet the point's own ground.
  const Vector3 above_W = point.p_W + kOcclusionMargin_m * point.normal_W;
  return !terrain_.ground().CastRay(above_W, light_.toward_sun_W, kGroundShadow_m);
}

void ImageScene::Light(std::span<const int> shading, SurfacePoint& point) const {
  if (point.surface == SurfacePoint::kSky) {
    // An even sky of irradiance E has the radiance E / pi in every direction.
    point.radiance_w_m2_sr = light_.sky_w_m2 * std::numbers::inv_pi;
    return;
  }
  const bool sunlit = light_.direct_w_m2 > 0.0 && Sunlit(point, shading);
  point.radiance_w_m2_sr = SunRadiance(light_, point.albedo, point.normal_W, sunlit);
}

bool ImageScene::Reaches(const Vector3& lamp_W, const Vector3& p_W,
                         std::span<const int> rocks) const {
  const Vector3 away = p_W - lamp_W;
  const double distance_m = away.norm();
  const Vector3 ray_R = X_RW_.linear() * away / distance_m;
  // Parts that hold the lamp do not count: the lamp looks out of them.
  if (body_.Distance(X_RW_ * lamp_W, ray_R) < distance_m) return false;
  return !terrain_.Occluded(lamp_W, p_W, kOcclusionMargin_m, rocks);
}

using math::Vector3;

bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b) {
  constexpr double kFlat = 0.3;  // sine of the angle between chord and tangent plane
  if (a.surface != b.surface) return false;
  if (a.surface == SurfacePoint::kSky) return true;
  const Vector3 chord = b.p_W - a.p_W;
  const double out = std::max(std::abs(a.normal_W.dot(chord)), std::abs(b.normal_W.dot(chord)));
  return out * out <= kFlat * kFlat * chord.squaredNorm();
}

}  // namespace rockyard::rendering
