#include "rendering/picture/sun_shadows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"
#include "rendering/occlusion.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Rough ground further than this towards the sun casts no shadow. Must equal kGroundShadow_m of
// image_scene.cc.
constexpr double kGroundShadowReach_m = 2.0;
// Size of the cells of the grid across the sun's rays. Where there would be more than kMostSunCells
// of them, they are larger. Cells decide time and memory alone.
constexpr double kSunCell_m = 0.06;
constexpr double kMostSunCells = 1e6;
// Number of rays over the disc by which a cap is asked.
constexpr int kCapRays = 8;

// Returns the share of a unit disc on the side x > -d of the line x = -d, -1 < d < 1:
//   1/2 + (d sqrt(1 - d^2) + asin d) / pi.
double ShareOfDisc(double d) {
  return 0.5 + (d * std::sqrt(1.0 - d * d) + math::Asin(d)) * std::numbers::inv_pi;
}

}  // namespace

SunShadows::SunShadows(const terrain::Terrain& terrain, const Vector3& toward_sun_W,
                       double sun_diameter_rad, const PlacedBody& rover)
    : terrain_(terrain),
      toward_sun_W_(toward_sun_W),
      across_x_W_(toward_sun_W.unitOrthogonal()),
      across_y_W_(toward_sun_W.cross(across_x_W_)),
      half_diameter_rad_(0.5 * sun_diameter_rad),
      rover_(rover),
      X_RW_(rover.X_WR.inverse()),
      toward_sun_R_(X_RW_.linear() * toward_sun_W) {
  EXPECT(std::abs(toward_sun_W.squaredNorm() - 1.0) < 1e-9);
  if (rover_.body != nullptr) rover_center_W_ = rover_.X_WR * rover_.body->center_R();
  const int count = static_cast<int>(terrain.rocks().size());
  for (int rock = 0; rock < count; ++rock) AddSilhouette(rock);
  BuildGrid();
}

void SunShadows::AddSilhouette(int index) {
  const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
  const terrain::RockShape& shape = shapes_.emplace_back(rock);
  const Vector3 e = shape.Map(toward_sun_W_);
  const Vector3 a = shape.Map(across_x_W_);
  const Vector3 b = shape.Map(across_y_W_);
  const double speed2 = e.squaredNorm();
  Silhouette seen;
  seen.rock = index;
  seen.center_W = rock.center_W;
  seen.x_m = across_x_W_.dot(rock.center_W);
  seen.y_m = across_y_W_.dot(rock.center_W);
  // M_ab = a . b - (a . e)(b . e) / |e|^2.
  seen.xx = a.squaredNorm() - a.dot(e) * a.dot(e) / speed2;
  seen.xy = a.dot(b) - a.dot(e) * b.dot(e) / speed2;
  seen.yy = b.squaredNorm() - b.dot(e) * b.dot(e) / speed2;
  // q . e = (A (p - c)) . e for the unit vectors of W.
  for (int axis = 0; axis < 3; ++axis) {
    seen.along_per_m[axis] = shape.Map(Vector3::Unit(axis)).dot(e);
  }
  seen.speed2 = speed2;
  seen.is_cap = rock.cap_growth > 0.0;
  // The penumbra of a rock is as wide as half the disc seen from where its shadow ends: on level
  // ground at top / sin h. Twice that distance leaves room for ground that falls away.
  const double throw_m = 4.0 * rock.semi_axes_m.z() / std::max(toward_sun_W_.z(), 0.02);
  seen.reach_m = rock.semi_axes_m.maxCoeff() + throw_m * half_diameter_rad_ + kRounding_m;
  rocks_.push_back(seen);
}

void SunShadows::BuildGrid() {
  if (rocks_.empty()) return;
  Eigen::AlignedBox2d box;
  for (const Silhouette& rock : rocks_) {
    box.extend(Eigen::Vector2d(rock.x_m - rock.reach_m, rock.y_m - rock.reach_m));
    box.extend(Eigen::Vector2d(rock.x_m + rock.reach_m, rock.y_m + rock.reach_m));
  }
  const double cell_m = std::max(kSunCell_m, std::sqrt(box.volume() / kMostSunCells));
  cells_per_m_ = 1.0 / cell_m;
  x0_m_ = box.min().x();
  y0_m_ = box.min().y();
  cells_x_ = static_cast<int>(box.sizes().x() * cells_per_m_) + 1;
  cells_y_ = static_cast<int>(box.sizes().y() * cells_per_m_) + 1;
  // Counting sort of (cell, rock) pairs.
  const auto for_each_cell = [this](const Silhouette& rock, auto&& action) {
    const auto cell = [this](double offset_m, int cells) {
      return std::clamp(static_cast<int>(offset_m * cells_per_m_), 0, cells - 1);
    };
    const double dx = rock.x_m - x0_m_;
    const double dy = rock.y_m - y0_m_;
    for (int y = cell(dy - rock.reach_m, cells_y_); y <= cell(dy + rock.reach_m, cells_y_); ++y) {
      for (int x = cell(dx - rock.reach_m, cells_x_); x <= cell(dx + rock.reach_m, cells_x_); ++x) {
        action(static_cast<std::size_t>(y) * cells_x_ + x);
      }
    }
  };
  cell_start_.assign(static_cast<std::size_t>(cells_x_) * cells_y_ + 1, 0);
  for (const Silhouette& rock : rocks_) {
    for_each_cell(rock, [this](std::size_t cell) { ++cell_start_[cell + 1]; });
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  cell_rocks_.resize(static_cast<std::size_t>(cell_start_.back()));
  std::vector<int> fill(cell_start_.begin(), cell_start_.end() - 1);
  for (std::size_t i = 0; i < rocks_.size(); ++i) {
    for_each_cell(rocks_[i], [&](std::size_t cell) {
      cell_rocks_[static_cast<std::size_t>(fill[cell]++)] = static_cast<int>(i);
    });
  }
}

std::span<const int> SunShadows::CellAt(double x_m, double y_m) const {
  const double x = (x_m - x0_m_) * cells_per_m_;
  const double y = (y_m - y0_m_) * cells_per_m_;
  if (!(x >= 0.0 && x < cells_x_ && y >= 0.0 && y < cells_y_)) return {};
  const std::size_t cell = static_cast<std::size_t>(y) * cells_x_ + static_cast<std::size_t>(x);
  const int* first = cell_rocks_.data();
  return {first + cell_start_[cell], first + cell_start_[cell + 1]};
}

double SunShadows::LeftBy(const Silhouette& rock, const Vector3& p_W, double x_m,
                          double y_m) const {
  const double dx = x_m - rock.x_m;
  const double dy = y_m - rock.y_m;
  const double mx = rock.xx * dx + rock.xy * dy;
  const double my = rock.xy * dx + rock.yy * dy;
  const double m = mx * dx + my * dy;
  const double along = rock.along_per_m.dot(p_W - rock.center_W);
  if (along >= 0.0) return 1.0;  // the rock lies away from the sun
  if (half_diameter_rad_ == 0.0) return m < 1.0 ? 0.0 : 1.0;
  // The way from the point to where its ray is nearest to the centre, in the rock's own measure, is
  // -q.e / |e|^2.
  const double radius_m = half_diameter_rad_ * -along / rock.speed2;
  const double rho = std::sqrt(m);
  // grad sqrt(m) = M x / sqrt(m), so the distance from the edge is (rho - 1) rho / |M x|.
  const double outside_m = (rho - 1.0) * rho / std::max(std::sqrt(mx * mx + my * my), 1e-12);
  if (outside_m >= radius_m) return 1.0;
  if (outside_m <= -radius_m) return 0.0;
  return ShareOfDisc(outside_m / radius_m);
}

double SunShadows::LeftByCap(const Silhouette& rock, const Vector3& p_W) const {
  const terrain::RockShape& shape = shapes_[static_cast<std::size_t>(rock.rock)];
  const auto meets = [&](const Vector3& ray_W) {
    return shape.Distance(p_W, ray_W) < terrain::RockShape::kNoHit;
  };
  if (half_diameter_rad_ == 0.0) return meets(toward_sun_W_) ? 0.0 : 1.0;
  int seen = 0;
  for (int i = 0; i < kCapRays; ++i) {
    // A ring of 1/sqrt(2) of the radius has the disc's second moments.
    const double turn = 2.0 * std::numbers::pi * i / kCapRays;
    const double out = half_diameter_rad_ * std::numbers::sqrt2 * 0.5;
    const Vector3 ray_W =
        toward_sun_W_ + out * (math::Cos(turn) * across_x_W_ + math::Sin(turn) * across_y_W_);
    if (!meets(ray_W.normalized())) ++seen;
  }
  return static_cast<double>(seen) / kCapRays;
}

bool SunShadows::InRoversShadow(const Vector3& p_W) const {
  if (rover_.body == nullptr) return false;
  // The ball around the rover, seen along the sun's rays.
  const Vector3 away = rover_center_W_ - p_W;
  const double along = away.dot(toward_sun_W_);
  const double radius_m = rover_.body->radius_m();
  if (along < -radius_m || away.squaredNorm() - along * along > radius_m * radius_m) return false;
  return rover_.body->Distance(X_RW_ * p_W, toward_sun_R_) < RoverBody::kFree;
}

double SunShadows::Visible(const Vector3& p_W, const Vector3& normal_W, int surface) const {
  if (normal_W.dot(toward_sun_W_) <= 0.0) return 0.0;
  const double x_m = across_x_W_.dot(p_W);
  const double y_m = across_y_W_.dot(p_W);
  double left = 1.0;
  for (const int i : CellAt(x_m, y_m)) {
    const Silhouette& rock = rocks_[static_cast<std::size_t>(i)];
    // A rock is convex: where it faces the sun it does not shade itself.
    if (rock.rock == surface) continue;
    left *= rock.is_cap ? LeftByCap(rock, p_W) : LeftBy(rock, p_W, x_m, y_m);
    if (left == 0.0) return 0.0;
  }
  if (InRoversShadow(p_W)) return 0.0;
  if (terrain_.ground().IsPlane()) return left;
  const Vector3 above_W = p_W + kOcclusionMargin_m * normal_W;
  return terrain_.ground().CastRay(above_W, toward_sun_W_, kGroundShadowReach_m,
                                   terrain::RayWay::kSpline)
             ? 0.0
             : left;
}

}  // namespace rockyard::rendering
