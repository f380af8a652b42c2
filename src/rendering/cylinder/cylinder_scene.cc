#include "rendering/cylinder/cylinder_scene.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "math/functions.h"

namespace rockyard::rendering {
namespace {

using core::SampleUniform;
using math::Vector3;

// Returns the smaller root of a t^2 + 2 b t + c = 0; nothing where there is none or it lies behind.
std::optional<double> FirstRoot(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
  const double root = (-b - std::sqrt(discriminant)) / a;
  if (root <= 0.0) return std::nullopt;
  return root;
}

ColouredBody Plain(BodyShape shape, const Vector3& middle_L, const Vector3& half,
                   double heading_rad, const Colour& colour) {
  ColouredBody body{shape, middle_L, half, heading_rad, {}};
  body.colours.fill(colour);
  return body;
}

ColouredBody Cylinder(const CylinderTargetParams& target, const math::Transform& X_LT) {
  const double radius_m = 0.5 * target.diameter_m;
  ColouredBody body =
      Plain(BodyShape::kCylinder, X_LT.translation(), {radius_m, radius_m, 0.5 * target.height_m},
            math::Heading(X_LT), ToColour(target.top));
  const bool green = target.third_colour == ThirdColour::kGreen;
  body.colours[0] = ToColour(target.blue);
  body.colours[1] = ToColour(target.pink);
  body.colours[2] = ToColour(green ? target.green : target.orange);
  body.colours[3] = ToColour(target.pink);
  return body;
}

// Adds boxes below the cylinder, from the ground up to it.
void AddStand(const CylinderTargetParams& target, const math::Transform& X_LT,
              std::vector<BodyCaster>& bodies) {
  const double bottom_m = target.middle_height_m - 0.5 * target.height_m;
  const double heading_rad = math::Heading(X_LT);
  const auto add = [&](double low_m, double high_m, double half_x_m, double half_y_m,
                       const Colour& colour) {
    Vector3 middle_L = X_LT.translation();
    middle_L.z() = 0.5 * (low_m + high_m);
    if (high_m <= low_m) return;
    bodies.emplace_back(Plain(BodyShape::kBox, middle_L,
                              {half_x_m, half_y_m, 0.5 * (high_m - low_m)}, heading_rad, colour));
  };
  const Colour metal(0.35, 0.34, 0.32);
  constexpr double kPlate_m = 0.02;
  if (target.stand == CylinderStand::kTurntable) {
    add(0.0, bottom_m - kPlate_m, 0.05, 0.05, metal);
    add(bottom_m - kPlate_m, bottom_m, 0.11, 0.11, metal);
    return;
  }
  // A rover's size of 0.63 m by 0.48 m; its deck lies a hand below the cylinder.
  const Colour solar_cells(0.07, 0.08, 0.12);
  const double deck_m = 0.85 * bottom_m;
  add(deck_m, bottom_m, 0.02, 0.02, metal);
  add(deck_m - kPlate_m, deck_m, 0.315, 0.24, solar_cells);
  add(0.4 * bottom_m, deck_m - kPlate_m, 0.25, 0.17, metal);
  const Colour wheels(0.12, 0.11, 0.10);
  const Vector3 forward = X_LT.linear().col(0);
  const Vector3 left = X_LT.linear().col(1);
  for (const double ahead : {-0.22, 0.0, 0.22}) {
    for (const double aside : {-0.2, 0.2}) {
      Vector3 middle_L = X_LT.translation() + ahead * forward + aside * left;
      middle_L.z() = 0.065;
      bodies.emplace_back(
          Plain(BodyShape::kBox, middle_L, {0.065, 0.04, 0.065}, heading_rad, wheels));
    }
  }
}

// Where clutter lies on the ground.
struct Place {
  double x_m;
  double y_m;
};

Place DrawPlace(const CylinderPictureParams& params, core::RandomStream& stream) {
  const double near_2 = params.clutter.nearest_m * params.clutter.nearest_m;
  const double far_2 = params.clutter.farthest_m * params.clutter.farthest_m;
  const double x_m = std::sqrt(SampleUniform(stream, near_2, far_2));
  const double half = math::Tan(0.5 * params.cameras.field_of_view_rad);
  return {x_m, x_m * half * SampleUniform(stream, -1.0, 1.0)};
}

bool IsClear(const Place& place, double half_m, const CylinderPictureParams& params,
             const math::Transform& X_LT) {
  const double away_m =
      math::Hypot(place.x_m - X_LT.translation().x(), place.y_m - X_LT.translation().y());
  return away_m - half_m >= params.clutter.clear_m;
}

double DrawHalf(double smallest_m, double largest_m, core::RandomStream& stream) {
  return math::Exp(SampleUniform(stream, math::Log(smallest_m), math::Log(largest_m)));
}

void AddRocks(const CylinderPictureParams& params, const math::Transform& X_LT, core::TrialKey key,
              std::vector<BodyCaster>& bodies) {
  const ClutterParams& clutter = params.clutter;
  core::RandomStream stream(key, core::Purpose::kCylinderScene, 0);
  const std::int64_t count = core::SamplePoisson(stream, clutter.rocks);
  for (std::int64_t i = 0; i < count; ++i) {
    const Place place = DrawPlace(params, stream);
    const double half_m = DrawHalf(clutter.smallest_m, clutter.largest_m, stream);
    const double width_m = half_m * SampleUniform(stream, 0.6, 1.0);
    const double height_m = half_m * SampleUniform(stream, 0.4, 0.9);
    const double heading_rad = SampleUniform(stream, 0.0, std::numbers::pi);
    const bool red = core::SampleBernoulli(stream, clutter.red_share);
    const double brightness =
        1.0 + clutter.rock_brightness_spread * SampleUniform(stream, -1.0, 1.0);
    // Must come after all draws of the rock: then the place of the cylinder moves no other rock.
    if (!IsClear(place, half_m, params, X_LT)) continue;
    const Colour colour = brightness * ToColour(red ? clutter.red_rock : clutter.rock);
    constexpr double kSunk = 0.1;
    bodies.emplace_back(Plain(BodyShape::kEllipsoid,
                              {place.x_m, place.y_m, (1.0 - 2.0 * kSunk) * height_m},
                              {half_m, width_m, height_m}, heading_rad, colour));
  }
}

// Adds hardware. Each channel of its colours is uniform: any colour that paint, foil or cloth may
// have.
void AddHardware(const CylinderPictureParams& params, const math::Transform& X_LT,
                 core::TrialKey key, std::vector<BodyCaster>& bodies) {
  const ClutterParams& clutter = params.clutter;
  core::RandomStream stream(key, core::Purpose::kCylinderScene, 1);
  const std::int64_t count = core::SamplePoisson(stream, clutter.hardware);
  for (std::int64_t i = 0; i < count; ++i) {
    const Place place = DrawPlace(params, stream);
    const double half_m = DrawHalf(clutter.smallest_m, clutter.hardware_largest_m, stream);
    const double width_m = half_m * SampleUniform(stream, 0.3, 1.0);
    const double height_m = half_m * SampleUniform(stream, 0.3, 1.0);
    const double heading_rad = SampleUniform(stream, 0.0, std::numbers::pi);
    Colour colour;
    for (double& channel : colour) channel = SampleUniform(stream, 0.05, 0.95);
    if (!IsClear(place, math::Hypot(half_m, width_m), params, X_LT)) continue;
    bodies.emplace_back(Plain(BodyShape::kBox, {place.x_m, place.y_m, height_m},
                              {half_m, width_m, height_m}, heading_rad, colour));
  }
}

}  // namespace

BodyCaster::BodyCaster(ColouredBody body)
    : body_(body), cosine_(math::Cos(body.heading_rad)), sine_(math::Sin(body.heading_rad)) {}

std::array<Vector3, 8> BodyCaster::Corners() const {
  std::array<Vector3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double x = (i & 1U) != 0U ? body_.half.x() : -body_.half.x();
    const double y = (i & 2U) != 0U ? body_.half.y() : -body_.half.y();
    const double z = (i & 4U) != 0U ? body_.half.z() : -body_.half.z();
    corners[i] = body_.middle_L + Vector3(cosine_ * x - sine_ * y, sine_ * x + cosine_ * y, z);
  }
  return corners;
}

std::optional<BodyHit> BodyCaster::Cast(const ColourRay& ray) const {
  const auto turned = [this](const Vector3& v) {
    return Vector3(cosine_ * v.x() + sine_ * v.y(), cosine_ * v.y() - sine_ * v.x(), v.z());
  };
  const ColourRay ray_B{turned(ray.origin - body_.middle_L), turned(ray.direction)};
  std::optional<BodyHit> hit;
  switch (body_.shape) {
    case BodyShape::kEllipsoid:
      hit = CastEllipsoid(ray_B);
      break;
    case BodyShape::kBox:
      hit = CastBox(ray_B);
      break;
    case BodyShape::kCylinder:
      hit = CastCylinder(ray_B);
      break;
  }
  if (hit) {
    const Vector3 n = hit->normal;
    hit->normal = {cosine_ * n.x() - sine_ * n.y(), sine_ * n.x() + cosine_ * n.y(), n.z()};
  }
  return hit;
}

// |(o + t d) / h|^2 = 1; the normal is along p / h^2.
std::optional<BodyHit> BodyCaster::CastEllipsoid(const ColourRay& ray_B) const {
  const Vector3 o = ray_B.origin.cwiseQuotient(body_.half);
  const Vector3 d = ray_B.direction.cwiseQuotient(body_.half);
  const auto along = FirstRoot(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0);
  if (!along) return std::nullopt;
  const Vector3 normal = (o + *along * d).cwiseQuotient(body_.half).normalized();
  return BodyHit{*along, normal, 0};
}

// The ray meets the box where it enters the last of the three slabs, unless it has left another
// before.
std::optional<BodyHit> BodyCaster::CastBox(const ColourRay& ray_B) const {
  double entered = 0.0;
  double left = std::numeric_limits<double>::infinity();
  int face = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = ray_B.direction[axis];
    if (speed == 0.0) {
      if (std::abs(ray_B.origin[axis]) > body_.half[axis]) return std::nullopt;
      continue;
    }
    const double reach = std::copysign(body_.half[axis], speed);
    const double in = (-reach - ray_B.origin[axis]) / speed;
    if (in > entered) {
      entered = in;
      face = 2 * axis + (speed > 0.0 ? 0 : 1);
    }
    left = std::fmin(left, (reach - ray_B.origin[axis]) / speed);
  }
  if (face < 0 || entered > left) return std::nullopt;
  Vector3 normal = Vector3::Zero();
  normal[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
  return BodyHit{entered, normal, face};
}

std::optional<BodyHit> BodyCaster::CastCylinder(const ColourRay& ray_B) const {
  const Vector3& o = ray_B.origin;
  const Vector3& d = ray_B.direction;
  const double radius_m = body_.half.x();
  const auto wall = FirstRoot(d.x() * d.x() + d.y() * d.y(), o.x() * d.x() + o.y() * d.y(),
                              o.x() * o.x() + o.y() * o.y() - radius_m * radius_m);
  if (!wall) return std::nullopt;
  const Vector3 p = o + *wall * d;
  if (std::abs(p.z()) <= body_.half.z()) {
    // Quadrant q lies between the azimuths 90 q and 90 (q + 1) deg of the cylinder.
    const int quadrant = p.y() >= 0.0 ? (p.x() > 0.0 ? 0 : 1) : (p.x() < 0.0 ? 2 : 3);
    return BodyHit{*wall, {p.x() / radius_m, p.y() / radius_m, 0.0}, quadrant};
  }
  if (p.z() < 0.0 || d.z() >= 0.0) return std::nullopt;
  const double along = (body_.half.z() - o.z()) / d.z();
  const Vector3 on_top = o + along * d;
  if (math::Hypot(on_top.x(), on_top.y()) > radius_m) return std::nullopt;
  return BodyHit{along, Vector3::UnitZ(), 4};
}

std::vector<BodyCaster> CylinderBodies(const CylinderPictureParams& params,
                                       const CylinderView& view, core::TrialKey key) {
  const math::Transform X_LT = CylinderPose(params, view);
  std::vector<BodyCaster> bodies;
  if (view.present) {
    bodies.emplace_back(Cylinder(params.target, X_LT));
    AddStand(params.target, X_LT, bodies);
  }
  AddRocks(params, X_LT, key, bodies);
  AddHardware(params, X_LT, key, bodies);
  return bodies;
}

}  // namespace rockyard::rendering
