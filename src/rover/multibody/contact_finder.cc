#include "rover/multibody/contact_finder.h"

#include <algorithm>
#include <tuple>

#include "math/functions.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// The list of near rocks is renewed after this much travel, m.
constexpr double kGatherStep_m = 0.1;
// Pairs nearer than this are followed from step to step, m.
constexpr double kFollowedGap_m = 0.03;
// Alternating projections: sweeps for a followed pair and for a new one, and the movement below
// which a sweep ends them, m.
constexpr int kSweeps = 3;
constexpr int kFirstSweeps = 30;
constexpr double kConverged_m = 1e-6;

}  // namespace

ContactFinder::ContactFinder(const RoverGeometryParams& params, const terrain::Terrain& terrain)
    : terrain_(terrain),
      parts_(MakeParts(params)),
      reach_m_(math::Hypot(0.5 * params.length_m, 0.5 * params.width_m) + 2.0 * kFollowedGap_m) {
  rocks_.reserve(terrain.rocks().size());
  for (const terrain::Rock& rock : terrain.rocks()) rocks_.emplace_back(rock);
}

void ContactFinder::Clear() {
  contacts_.clear();
  gathered_ = false;
}

void ContactFinder::ScaleImpulses(double ratio) {
  for (Contact& contact : contacts_) {
    for (double& impulse_Ns : contact.impulse_Ns) impulse_Ns *= ratio;
    contact.drag_Ns *= ratio;
    contact.side_Ns *= ratio;
  }
}

void ContactFinder::OnRockMoved(int rock) {
  RockBody& body = rocks_[static_cast<std::size_t>(rock)];
  const Vector3 before_W = body.center_W();
  // The nearest point moves along with its rock, as a start for the next search.
  body = RockBody(terrain_.rocks()[static_cast<std::size_t>(rock)]);
  for (Contact& contact : contacts_) {
    if (contact.other == rock) contact.near_W += body.center_W() - before_W;
  }
  gathered_ = false;
}

void ContactFinder::Update(const Multibody& body) {
  std::swap(contacts_, last_);
  contacts_.clear();
  next_last_ = 0;
  GatherRocks(body.X_WR().translation());
  // R's z axis against the vertical, cosine of the rover's tilt.
  const bool upright = terrain_.ground().IsPlane() && body.X_WR().linear()(2, 2) > kUprightCosine;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    const int index = static_cast<int>(i);
    const math::Transform& X_WB = body.X_WB(part.body);
    if (part.meets == Meets::kGroundAndWalls) {
      MeetWalls(index, X_WB);
      if (!upright) MeetGround(index, X_WB);
      continue;
    }
    if (part.meets == Meets::kEverything) {
      MeetWheelGround(index, X_WB);
    }
    const Vector3 center_W = X_WB * part.center_B;
    // RocksNear lists rocks by rising index, the order that Add asks for.
    for (std::size_t k = 0; k < near_rocks_.size(); ++k) {
      MeetRock(index, X_WB, center_W, near_rocks_[k], planes_[i * near_rocks_.size() + k]);
    }
  }
}

void ContactFinder::GatherRocks(const Vector3& p_WRo) {
  if (gathered_ && (p_WRo - gathered_at_W_).head<2>().norm() < kGatherStep_m) return;
  terrain_.RocksNear(p_WRo.x(), p_WRo.y(), reach_m_ + kGatherStep_m, near_rocks_);
  planes_.assign(parts_.size() * near_rocks_.size(), {{}, Vector3::Zero(), 0.0});
  gathered_at_W_ = p_WRo;
  gathered_ = true;
}

Contact& ContactFinder::Add(int part, int other, bool& found) {
  // Calls must come in the order of (part, other), in which both lists are, so that one pass
  // through last_ finds every pair again.
  const auto key = std::tuple(part, other);
  while (next_last_ < last_.size() &&
         std::tuple(last_[next_last_].part, last_[next_last_].other) < key) {
    ++next_last_;
  }
  found = next_last_ < last_.size() &&
          std::tuple(last_[next_last_].part, last_[next_last_].other) == key;
  if (found) {
    contacts_.push_back(last_[next_last_]);
  } else {
    contacts_.push_back({.part = part, .other = other});
  }
  return contacts_.back();
}

void ContactFinder::SetTangents(const math::Transform& X_WB, Contact& contact) const {
  // A wheel rolls across its axle; where the normal is the axle (side of the wheel), along_W is any
  // tangent.
  Vector3 along = X_WB.linear().col(1).cross(contact.n_W);
  if (along.squaredNorm() < 1e-4) along = Vector3::UnitZ().cross(contact.n_W);
  contact.along_W = along.normalized();
  contact.across_W = contact.n_W.cross(contact.along_W);
}

Vector3 ContactFinder::Support(const Part& part, const math::Transform& X_WB, const Vector3& n_W) {
  Vector3 p_W = X_WB * part.center_B;
  // Wheels are the only parts with an extent that meet planes; corners are points.
  if (part.core != Core::kCylinder) return p_W;
  const Vector3 axle_W = X_WB.linear().col(1);
  // Sine of the angle by which the axle dips towards the plane.
  const double tilt = -n_W.dot(axle_W);
  const Vector3 down_W = -n_W - tilt * axle_W;  // in the plane of the rim
  const double size = down_W.norm();
  p_W += part.b_B.y() * std::clamp(tilt / kEdgeTilt, -1.0, 1.0) * axle_W;
  // Down the rim by the core's radius; where wheel and plane are parallel the direction is
  // undefined, and the bound lets it fade.
  p_W += part.b_B.x() / std::max(size, kEdgeTilt) * down_W;
  return p_W - part.margin_m * n_W;
}

void ContactFinder::MeetGround(int index, const math::Transform& X_WB) {
  const Part& part = parts_[static_cast<std::size_t>(index)];
  const Vector3 center_W = X_WB * part.center_B;
  const terrain::Ground& ground = terrain_.ground();
  const auto support = [&](const Vector3& n_W) { return Support(part, X_WB, n_W); };
  AddGround(index, kGround, TouchAlong(ground, ground.Normal(center_W.x(), center_W.y()), support),
            X_WB);
}

// Contacts are added in the order of `other`: kGroundAhead, walls, kGround.
void ContactFinder::MeetWheelGround(int index, const math::Transform& X_WB) {
  const Part& part = parts_[static_cast<std::size_t>(index)];
  const auto support = [&](const Vector3& n_W) { return Support(part, X_WB, n_W); };
  const GroundTouches found =
      FindGroundTouches(terrain_.ground(), X_WB * part.center_B, X_WB.linear().col(1),
                        part.bounding_radius_m + kFollowedGap_m, support);
  if (found.count == 2) AddGround(index, kGroundAhead, found.touches[1], X_WB);
  MeetWalls(index, X_WB);
  AddGround(index, kGround, found.touches[0], X_WB);
}

void ContactFinder::AddGround(int index, int other, const GroundTouch& touch,
                              const math::Transform& X_WB) {
  if (touch.gap_m > kFollowedGap_m) return;
  bool found = false;
  Contact& contact = Add(index, other, found);
  contact.gap_m = touch.gap_m;
  contact.p_W = touch.p_W;
  contact.n_W = touch.n_W;
  SetTangents(X_WB, contact);
}

void ContactFinder::MeetWalls(int index, const math::Transform& X_WB) {
  const Part& part = parts_[static_cast<std::size_t>(index)];
  const Vector3 center_W = X_WB * part.center_B;
  const double reach_m = part.bounding_radius_m + kFollowedGap_m;
  const auto walls = terrain_.walls();
  // Wall i is kFirstWall - i, so counting down keeps contacts ordered by `other`.
  for (std::size_t i = walls.size(); i-- > 0;) {
    if (walls[i].offset_m - walls[i].normal_W.dot(center_W) > reach_m) continue;
    const Vector3 p_W = Support(part, X_WB, -walls[i].normal_W);
    const double gap_m = walls[i].offset_m - walls[i].normal_W.dot(p_W);
    if (gap_m > kFollowedGap_m) continue;
    bool found = false;
    Contact& contact = Add(index, kFirstWall - static_cast<int>(i), found);
    contact.gap_m = gap_m;
    contact.p_W = p_W;
    contact.n_W = -walls[i].normal_W;
    SetTangents(X_WB, contact);
  }
}

bool ContactFinder::AreApart(const Part& part, const math::Transform& X_WB,
                             const SurfacePoint& surface) {
  // The tangent plane of the rock at that point separates part and rock if the whole part lies
  // beyond the plane: min n . (x - p) over the core, less the margin.
  const Vector3 n_B = X_WB.linear().transpose() * surface.normal_W;
  const double min_m =
      LeastAlong(part, n_B) + surface.normal_W.dot(X_WB.translation() - surface.point_W);
  return min_m - part.margin_m > kFollowedGap_m;
}

void ContactFinder::MeetRock(int index, const math::Transform& X_WB, const Vector3& center_W,
                             int rock, SurfacePoint& plane) {
  const Part& part = parts_[static_cast<std::size_t>(index)];
  const RockBody& body = rocks_[static_cast<std::size_t>(rock)];
  // Bounding balls first.
  const double reach_m = part.bounding_radius_m + kFollowedGap_m;
  const double far_m = reach_m + body.bounding_radius_m();
  if ((center_W - body.center_W()).squaredNorm() > far_m * far_m) return;
  // Cheap test before the nearest point, which needs a root.
  if (body.DistanceBound(center_W) > reach_m) return;
  if (!plane.normal_W.isZero(0.0) && AreApart(part, X_WB, plane)) return;

  bool found = false;
  Contact& contact = Add(index, rock, found);
  const Eigen::Matrix3d R_BW = X_WB.linear().transpose();
  SurfacePoint surface{contact.near_W, contact.n_W, 0.0};
  if (!found) plane = surface = body.Nearest(center_W);
  if (!found && AreApart(part, X_WB, surface)) {
    contacts_.pop_back();
    return;
  }
  const int sweeps = found ? kSweeps : kFirstSweeps;
  Vector3 core_W = center_W;
  for (int i = 0; i < sweeps; ++i) {
    // Alternating projections onto two convex sets, core and rock: the distance falls with every
    // sweep.
    core_W = X_WB * NearestOnCore(part, R_BW * (surface.point_W - X_WB.translation()));
    const Vector3 before_W = surface.point_W;
    surface = body.Nearest(core_W, &before_W);
    if (AreApart(part, X_WB, surface)) break;
    if ((surface.point_W - before_W).squaredNorm() < kConverged_m * kConverged_m) break;
  }
  contact.gap_m = surface.distance_m - part.margin_m;
  if (contact.gap_m > kFollowedGap_m) {
    contacts_.pop_back();
    return;
  }
  contact.near_W = surface.point_W;
  contact.n_W = surface.normal_W;
  contact.p_W = core_W - part.margin_m * surface.normal_W;
  SetTangents(X_WB, contact);
}

}  // namespace rockyard::rover
