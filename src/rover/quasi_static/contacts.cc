#include "rover/quasi_static/contacts.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"
#include "rover/ground_touches.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// The list of near rocks is renewed after this much travel, m.
constexpr double kRegatherStep_m = 0.25;
// Alternating projections of a body part: most sweeps, and the movement that ends them, m.
constexpr int kMostSweeps = 20;
constexpr double kResting_m = 1e-4;

// Returns the height of the lowest point of a part that rocks can touch.
double LowestPoint(const Part& part, const Linkage::Frame& frame) {
  const auto down = frame.R_WB.row(2);
  if (part.core == Core::kBox) {
    return frame.p_WB.z() + down * part.a_B - down.cwiseAbs() * part.b_B - part.margin_m;
  }
  const double a_m = down * part.a_B;
  const double b_m = down * part.b_B;
  return frame.p_WB.z() + std::min(a_m, b_m) - part.margin_m;
}

// Returns how far a part extends from its centre along n.
double Extent(const Part& part, const Linkage::Frame& frame, const Vector3& n_W) {
  const Vector3 n_B = frame.R_WB.transpose() * n_W;
  const double core_m = part.core == Core::kBox ? n_B.cwiseAbs().dot(part.b_B)
                                                : 0.5 * std::abs(n_B.dot(part.b_B - part.a_B));
  return core_m + part.margin_m;
}

// Returns a lower bound of the gap between a part and a rock, a cheap way out before the
// projections: f(n) = n . (c_part - c_rock) - D(n) - extent of the part along n is no more than the
// gap for any unit n.
double Separation(const Part& part, const Linkage::Frame& frame, const Vector3& center_W,
                  const RockSupport& rock) {
  const Vector3 n_W = rock.GuessNormal(center_W);
  return n_W.dot(center_W - rock.center_W()) - rock.Along(n_W) - Extent(part, frame, n_W);
}

}  // namespace

QuasiStaticContacts::QuasiStaticContacts(const RoverGeometryParams& params,
                                         const terrain::Terrain& terrain)
    : terrain_(terrain),
      wheel_(params),
      parts_(MakeParts(params)),
      reach_R_m_(math::Hypot(0.5 * params.length_m, 0.5 * params.width_m)),
      hub_radius_m_(params.hub_radius_m) {
  for (std::size_t i = messages::kWheelCount; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.meets != Meets::kRocks) continue;
    if (bodies_.empty() || bodies_.back().body != part.body) {
      bodies_.push_back({part.body, rock_parts_.size(), rock_parts_.size(), part.center_B});
    }
    rock_parts_.push_back(i);
    BodyParts& body = bodies_.back();
    body.last = rock_parts_.size();
    // The ball is about the centre of the body's first part, and holds all of its parts.
    body.radius_m =
        std::max(body.radius_m, (part.center_B - body.center_B).norm() + part.bounding_radius_m);
  }
}

void QuasiStaticContacts::Clear() {
  contacts_.clear();
  gathered_ = false;
}

// Lists the rocks near the rover, for as long as it stays within kRegatherStep_m of here: the
// radius has room for that way twice.
void QuasiStaticContacts::Gather(const Vector3& p_WR) {
  if (gathered_ &&
      (p_WR - gathered_at_W_).head<2>().squaredNorm() < kRegatherStep_m * kRegatherStep_m)
    return;
  terrain_.RocksNear(p_WR.x(), p_WR.y(), reach_R_m_ + 2.0 * kRegatherStep_m, near_);
  rocks_.clear();
  for (const int index : near_) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    rocks_.push_back({index, RockSupport(rock), RockBody(rock), {}, {}});
  }
  clear_until_m_.assign(rocks_.size() * rock_parts_.size(), 0.0);
  for (BodyParts& body : bodies_) body.way_m = 0.0;
  gathered_at_W_ = p_WR;
  gathered_ = true;
}

bool QuasiStaticContacts::MayMeetObstacle(const Vector3& p_WR, double reach_m) {
  if (!terrain_.walls().empty()) return true;
  Gather(p_WR);
  return std::any_of(rocks_.begin(), rocks_.end(), [&](const NearRock& rock) {
    const double far_m = reach_R_m_ + rock.support.bounding_radius_m() + reach_m;
    return (rock.support.center_W() - p_WR).head<2>().squaredNorm() < far_m * far_m;
  });
}

bool QuasiStaticContacts::WheelMayMeetObstacle(const Linkage& linkage, double reach_m) {
  if (!terrain_.walls().empty()) return true;
  Gather(linkage.chassis().p_WB);
  return std::any_of(rocks_.begin(), rocks_.end(), [&](const NearRock& rock) {
    for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
      if (IsNear(linkage.wheel_W(wheel), wheel, reach_m, rock)) return true;
    }
    return false;
  });
}

bool QuasiStaticContacts::IsNear(const Vector3& center_W, std::size_t wheel, double reach_m,
                                 const NearRock& rock) const {
  const double far_m = rock.support.bounding_radius_m() + parts_[wheel].bounding_radius_m + reach_m;
  return (center_W - rock.support.center_W()).squaredNorm() <= far_m * far_m;
}

void QuasiStaticContacts::Update(const Linkage& linkage, double reach_m) {
  // The last contacts stay at hand: Add looks a pair's load up in them.
  std::swap(contacts_, last_);
  contacts_.clear();
  Gather(linkage.chassis().p_WB);
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    MeetGround(linkage, wheel, reach_m);
    MeetWalls(linkage, wheel, reach_m);
    for (NearRock& rock : rocks_) MeetRock(linkage, wheel, reach_m, rock);
  }
  MeetBody(linkage, reach_m);
  MeetCorners(linkage, reach_m);
}

// A contact that goes on starts from its last load, from which the next balance takes stiffness and
// traction.
void QuasiStaticContacts::Add(const RestingContact& contact) {
  contacts_.push_back(contact);
  for (const RestingContact& before : last_) {
    if (before.part == contact.part && before.other == contact.other) {
      contacts_.back().load_N = before.load_N;
      contacts_.back().traction_load_N = before.traction_load_N;
      contacts_.back().traction_N = before.traction_N;
      return;
    }
  }
}

// Returns the point of the rounded cylinder that reaches farthest against n, moved across the rim
// in proportion to the tilt. Must agree with ContactFinder::Support (multibody/contact_finder.cc).
Vector3 QuasiStaticContacts::WheelSupport(const Linkage& linkage, std::size_t wheel,
                                          const Vector3& n_W) const {
  const Vector3 axle_W = linkage.axle_W(wheel);
  const double tilt = -n_W.dot(axle_W);
  const Vector3 down_W = -n_W - tilt * axle_W;  // in the plane of the rim
  const double across_m = wheel_.core_half_width_m * std::clamp(tilt / kEdgeTilt, -1.0, 1.0);
  return linkage.wheel_W(wheel) + across_m * axle_W +
         wheel_.core_radius_m / std::max(down_W.norm(), kEdgeTilt) * down_W - wheel_.margin_m * n_W;
}

void QuasiStaticContacts::MeetGround(const Linkage& linkage, std::size_t wheel, double reach_m) {
  const auto support = [&](const Vector3& n_W) { return WheelSupport(linkage, wheel, n_W); };
  const GroundTouches found =
      FindGroundTouches(terrain_.ground(), linkage.wheel_W(wheel), linkage.axle_W(wheel),
                        parts_[wheel].bounding_radius_m + reach_m, support);
  for (std::size_t i = 0; i < found.count; ++i) {
    const GroundTouch& touch = found.touches[i];
    if (touch.gap_m > reach_m) continue;
    Add({.part = static_cast<int>(wheel),
         .other = i == 0 ? kGround : kGroundAhead,
         .body = kFirstWheel + static_cast<int>(wheel),
         .gap_m = touch.gap_m,
         .p_W = touch.p_W,
         .n_W = touch.n_W});
  }
}

void QuasiStaticContacts::MeetWalls(const Linkage& linkage, std::size_t wheel, double reach_m) {
  const auto walls = terrain_.walls();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Vector3 n_W = -walls[i].normal_W;
    const Vector3 p_W = WheelSupport(linkage, wheel, n_W);
    // n_W points into the arena, against the wall's own normal: gap = offset - normal . p.
    const double gap_m = walls[i].offset_m + n_W.dot(p_W);
    if (gap_m > reach_m) continue;
    Add({.part = static_cast<int>(wheel),
         .other = kFirstWall - static_cast<int>(i),
         .body = kFirstWheel + static_cast<int>(wheel),
         .gap_m = gap_m,
         .p_W = p_W,
         .n_W = n_W});
  }
}

void QuasiStaticContacts::MeetRock(const Linkage& linkage, std::size_t wheel, double reach_m,
                                   NearRock& rock) {
  const Vector3& center_W = linkage.wheel_W(wheel);
  if (!IsNear(center_W, wheel, reach_m, rock)) {
    rock.known[wheel] = false;
    return;
  }
  if (!rock.known[wheel]) rock.wheel_normal_W[wheel] = rock.support.GuessNormal(center_W);
  rock.known[wheel] = true;
  const WheelRockGap gap = FindGap(wheel_, center_W, linkage.axle_W(wheel), rock.support, reach_m,
                                   rock.wheel_normal_W[wheel]);
  // The normal starts the search of the next balance, a few centimetres on.
  rock.wheel_normal_W[wheel] = gap.n_W;
  if (gap.gap_m > reach_m) return;
  Add({.part = static_cast<int>(wheel),
       .other = rock.index,
       .body = kFirstWheel + static_cast<int>(wheel),
       .gap_m = gap.gap_m,
       .p_W = gap.p_W,
       .n_W = gap.n_W});
}

void QuasiStaticContacts::MeetBody(const Linkage& linkage, double reach_m) {
  const Linkage::Frame& chassis = linkage.chassis();
  // Hubs are the lowest parts of the body beside the wheels: lower rocks meet wheels only.
  double lowest_m = chassis.p_WB.z() + 1.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    lowest_m = std::min(lowest_m, linkage.wheel_W(i).z() - hub_radius_m_ - reach_m);
  }
  PlaceBodies(linkage);
  double* until_m = clear_until_m_.data();
  for (const NearRock& rock : rocks_) {
    const bool low = rock.support.top_W_m() < lowest_m;
    for (const BodyParts& body : bodies_) {
      const std::size_t count = body.last - body.first;
      const auto is_near = [&](double clear_m) { return body.way_m + reach_m >= clear_m; };
      if (!low && std::any_of(until_m, until_m + count, is_near)) {
        MeetParts(linkage, body, reach_m, rock, until_m);
      }
      until_m += count;
    }
  }
}

void QuasiStaticContacts::MeetParts(const Linkage& linkage, const BodyParts& body, double reach_m,
                                    const NearRock& rock, double* until_m) {
  const double away_m = (rock.support.center_W() - body.center_W).norm() - body.radius_m -
                        rock.support.bounding_radius_m();
  for (std::size_t i = body.first; i < body.last; ++i, ++until_m) {
    if (body.way_m + reach_m < *until_m) continue;
    const double gap_m =
        away_m > reach_m ? away_m : MeetPart(linkage, rock_parts_[i], reach_m, rock);
    *until_m = body.way_m + gap_m;
  }
}

// Finds where the bodies with parts are, and how far their points have gone: a turn moves a point
// by no more than its distance from the centre times the change of the axes.
void QuasiStaticContacts::PlaceBodies(const Linkage& linkage) {
  for (BodyParts& body : bodies_) {
    const Linkage::Frame& frame = linkage.body(body.body);
    const Vector3 center_W = frame.p_WB + frame.R_WB * body.center_B;
    body.way_m +=
        (center_W - body.center_W).norm() + body.radius_m * (frame.R_WB - body.R_WB).norm();
    body.center_W = center_W;
    body.R_WB = frame.R_WB;
  }
}

double QuasiStaticContacts::MeetPart(const Linkage& linkage, std::size_t index, double reach_m,
                                     const NearRock& rock) {
  const Part& part = parts_[index];
  const Linkage::Frame& frame = linkage.body(part.body);
  const Vector3 center_W = frame.p_WB + frame.R_WB * part.center_B;
  const double above_m = LowestPoint(part, frame) - rock.support.top_W_m();
  if (above_m > reach_m) return above_m;
  const double far_m = part.bounding_radius_m + reach_m + rock.support.bounding_radius_m();
  const double away2_m2 = (center_W - rock.support.center_W()).squaredNorm();
  if (away2_m2 > far_m * far_m) return std::sqrt(away2_m2) - far_m + reach_m;
  const double apart_m = Separation(part, frame, center_W, rock.support);
  if (apart_m > reach_m) return apart_m;
  SurfacePoint surface = rock.body.Nearest(center_W);
  Vector3 core_W = center_W;
  // Alternating projections onto core and rock, see ContactFinder::MeetRock.
  for (int i = 0; i < kMostSweeps; ++i) {
    const Vector3 before_W = surface.point_W;
    core_W = frame.p_WB + frame.R_WB * NearestOnCore(part, frame.R_WB.transpose() *
                                                               (surface.point_W - frame.p_WB));
    surface = rock.body.Nearest(core_W);
    if ((surface.point_W - before_W).squaredNorm() < kResting_m * kResting_m) break;
  }
  const double gap_m = surface.distance_m - part.margin_m;
  if (gap_m > reach_m) return gap_m;
  Add({.part = static_cast<int>(index),
       .other = rock.index,
       .body = part.body,
       .kind = part.kind,
       .gap_m = gap_m,
       .p_W = core_W - part.margin_m * surface.normal_W,
       .n_W = surface.normal_W});
  return gap_m;
}

// Tests corners of chassis and panel against walls and, unless a rover stands upright on a plane,
// against the ground.
void QuasiStaticContacts::MeetCorners(const Linkage& linkage, double reach_m) {
  const Linkage::Frame& chassis = linkage.chassis();
  const terrain::Ground& ground = terrain_.ground();
  const bool upright = ground.IsPlane() && chassis.R_WB(2, 2) > kUprightCosine;
  const auto walls = terrain_.walls();
  if (upright && walls.empty()) return;
  for (std::size_t index = messages::kWheelCount; index < parts_.size(); ++index) {
    const Part& part = parts_[index];
    if (part.meets != Meets::kGroundAndWalls) continue;
    const Vector3 p_W = chassis.p_WB + chassis.R_WB * part.a_B;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      // A corner is a point without extent.
      const double gap_m = walls[i].offset_m - walls[i].normal_W.dot(p_W);
      if (gap_m > reach_m) continue;
      Add({.part = static_cast<int>(index),
           .other = kFirstWall - static_cast<int>(i),
           .kind = part.kind,
           .gap_m = gap_m,
           .p_W = p_W,
           .n_W = -walls[i].normal_W});
    }
    if (upright) continue;
    const Vector3 n_W = ground.Normal(p_W.x(), p_W.y());
    const double gap_m = (p_W.z() - ground.Height(p_W.x(), p_W.y())) * n_W.z();
    if (gap_m > reach_m) continue;
    Add({.part = static_cast<int>(index),
         .other = kGround,
         .kind = part.kind,
         .gap_m = gap_m,
         .p_W = p_W,
         .n_W = n_W});
  }
}

}  // namespace rockyard::rover
