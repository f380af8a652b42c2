#include "rendering/picture/terrain_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "math/functions.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Side of the square of the rocks' texture in which their pieces begin: large enough that two rocks
// alike are rare within an image, small enough that the pages of the texture are used again.
constexpr double kRockPieces_m = 0.5;
// A face whose component of the normal is smaller has no weight.
constexpr double kLeastComponent = 0.5;

double Mottled(double albedo, double contrast, double value) {
  return std::clamp(albedo * (1.0 + contrast * value), 0.0, 1.0);
}

}  // namespace

TerrainLook::Skin TerrainLook::MakeSkin(const TextureParams& texture, core::TrialKey key,
                                        core::Purpose purpose, std::int64_t most_taps) {
  TextureField field(texture, key, purpose, static_cast<int>(most_taps));
  const double relief_m = texture.relief_slope / field.SlopeDeviation();
  return {std::move(field), texture.contrast, relief_m};
}

TerrainLook::TerrainLook(const terrain::Terrain& terrain, const SunParams& sun,
                         const LookParams& look, core::TrialKey key)
    : sun_(sun),
      soil_(MakeSkin(look.Soil(), key, core::Purpose::kSoilTexture, look.texture_taps)),
      rock_(MakeSkin(look.rock, key, core::Purpose::kRockTexture, look.texture_taps)) {
  rocks_.reserve(terrain.rocks().size());
  for (const terrain::Rock& rock : terrain.rocks()) {
    core::RandomStream stream(key, core::Purpose::kRockLook,
                              static_cast<std::uint32_t>(rocks_.size()));
    // Cut where an albedo would turn negative.
    const double albedo =
        sun.rock_albedo * std::max(0.1, core::SampleNormal(stream, 1.0, look.rock_albedo_spread));
    const double u_m = core::SampleUniform(stream, 0.0, kRockPieces_m);
    const double v_m = core::SampleUniform(stream, 0.0, kRockPieces_m);
    rocks_.push_back({albedo, math::Cos(rock.yaw_rad), math::Sin(rock.yaw_rad), rock.center_W,
                      Eigen::Vector2d(u_m, v_m)});
  }
}

SurfaceLook TerrainLook::OfSoil(const SurfacePoint& point, const Vector3& by_column_W,
                                const Vector3& by_row_W) {
  const TextureSample texture =
      soil_.field.Mean(point.p_W.x(), point.p_W.y(), {by_column_W.head<2>(), by_row_W.head<2>()});
  // The surface z = h + relief v has the normal (-h_x - relief v_u, ...), up to its length.
  Vector3 normal_W = point.normal_W / std::max(point.normal_W.z(), 0.1);
  normal_W.x() -= soil_.relief_m * texture.slope_u;
  normal_W.y() -= soil_.relief_m * texture.slope_v;
  return {Mottled(sun_.ground_albedo, soil_.contrast, texture.value), normal_W.normalized()};
}

SurfaceLook TerrainLook::OfRock(const Rock& rock, const SurfacePoint& point,
                                const Vector3& by_column_W, const Vector3& by_row_W) {
  // The rock's own axes, turned by its yaw.
  const auto turned = [&rock](const Vector3& v) {
    return Vector3(rock.cosine * v.x() + rock.sine * v.y(), rock.cosine * v.y() - rock.sine * v.x(),
                   v.z());
  };
  const Vector3 p = turned(point.p_W - rock.center_W);
  const Vector3 n = turned(point.normal_W);
  const Vector3 by_column = turned(by_column_W);
  const Vector3 by_row = turned(by_row_W);
  const Eigen::Array3d weights = (n.array().abs() - kLeastComponent).max(0.0);
  // A unit vector has a component of 1/sqrt(3) at least, so that some weight is positive.
  const double norm = std::max(std::sqrt((weights * weights).sum()), 1e-9);
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (weights[axis] == 0.0) continue;
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    // Each face has a place of its own, a rock's width or more apart.
    const double shift_m = kRockPieces_m * axis;
    const TextureSample texture =
        rock_.field.Mean(p[a] + rock.piece_m.x() + shift_m, p[b] + rock.piece_m.y(),
                         {{by_column[a], by_column[b]}, {by_row[a], by_row[b]}});
    const double weight = weights[axis] / norm;
    value += weight * texture.value;
    gradient[a] += weight * texture.slope_u;
    gradient[b] += weight * texture.slope_v;
  }
  // The part of the gradient along the surface tilts the normal.
  const Vector3 along = gradient - n.dot(gradient) * n;
  const Vector3 tilted = n - rock_.relief_m * along;
  const Vector3 normal_W(rock.cosine * tilted.x() - rock.sine * tilted.y(),
                         rock.sine * tilted.x() + rock.cosine * tilted.y(), tilted.z());
  return {Mottled(rock.albedo, rock_.contrast, value), normal_W.normalized()};
}

SurfaceLook TerrainLook::At(const SurfacePoint& point, const Vector3& by_column_W,
                            const Vector3& by_row_W) {
  switch (point.surface) {
    case SurfacePoint::kGround:
      return OfSoil(point, by_column_W, by_row_W);
    case SurfacePoint::kWall:
      return {sun_.rock_albedo, point.normal_W};
    case SurfacePoint::kRover:
      return {sun_.rover_albedo, point.normal_W};
    case SurfacePoint::kSky:
      return {};
    default:
      return OfRock(rocks_[static_cast<std::size_t>(point.surface)], point, by_column_W, by_row_W);
  }
}

}  // namespace rockyard::rendering
