// The "virtual" arena as operators ran it (Matthies 1995 sec. 7): whenever the rover's position
// reaches a mirror line, operators turn the rover in place to the mirror-image heading and reflect
// its own estimate about the line. Drive asks them after every tick of an arc. Records of such an
// arena depend on it; it draws no random numbers, and operators make no error.
#pragma once

#include <cmath>
#include <optional>

#include "math/functions.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "trial/counters/drive_monitor.h"
#include "trial/drive/onboard.h"
#include "trial/drive/world.h"

namespace rockyard::trial {

// What operators do at a mirror line.
struct Reflection {
  math::Pose2 pose;             // true pose after the operators turned the rover
  messages::PoseUpdate update;  // estimate after its reflection
  double line_m = 0.0;          // y of the mirror line
};

// The arena between two mirror lines.
class MirrorArena {
 public:
  // The mirror lines are at y = +-half_width_m.
  explicit MirrorArena(double half_width_m) : half_width_m_(half_width_m) {}

  // Returns whether a rover at y is on or beyond a line, where Reflect may have something to do.
  bool Reaches(double y_m) const { return std::abs(y_m) >= half_width_m_; }

  // Returns the reflection of a rover on or beyond a line that drives outward, forwards (direction
  // +1) or backwards (-1). It turns the rover to the mirror-image heading, with which the same
  // drive leads inward.
  std::optional<Reflection> Reflect(const math::Pose2& pose, int direction,
                                    const messages::PoseEstimate& estimate) const;

 private:
  double half_width_m_;
};

inline std::optional<Reflection> MirrorArena::Reflect(
    const math::Pose2& pose, int direction, const messages::PoseEstimate& estimate) const {
  const double line_m = std::copysign(half_width_m_, pose.y_m);
  const bool outward = direction * math::Sin(pose.heading_rad) * line_m > 0.0;
  if (!Reaches(pose.y_m) || !outward) return std::nullopt;
  return Reflection{{pose.x_m, pose.y_m, -pose.heading_rad},
                    {estimate.x_m, 2.0 * line_m - estimate.y_m, -estimate.heading_rad, true},
                    line_m};
}

// The operators of one drive. They let a rover roll for a tick at least before they turn it again.
class Operators {
 public:
  // Both outlive it.
  Operators(const World& world, const Onboard& onboard) : world_(world), onboard_(onboard) {
    const terrain::ArenaParams& arena = world.params().terrain.arena;
    if (arena.kind == terrain::ArenaKind::kVirtualReflected) mirror_.emplace(arena.MirrorLine());
  }

  // Takes whether the rover rolls; called once a control tick.
  void OnWheels(bool moving) { has_rolled_ = has_rolled_ || moving; }

  // Returns what they do with a rover that drives in that direction, if anything.
  std::optional<Reflection> Reflect(int direction) {
    const math::Transform& X_WR = world_.state().X_WR;
    if (!mirror_ || !has_rolled_ || !mirror_->Reaches(X_WR.translation().y())) return std::nullopt;
    const auto reflection =
        mirror_->Reflect(math::ToPose2(X_WR), direction, WorldPose(onboard_.estimate()));
    if (reflection) has_rolled_ = false;
    return reflection;
  }

 private:
  const World& world_;
  const Onboard& onboard_;
  std::optional<MirrorArena> mirror_;
  bool has_rolled_ = true;  // whether the rover has rolled since they turned it
};

}  // namespace rockyard::trial
