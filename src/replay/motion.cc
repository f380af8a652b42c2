#include "replay/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json_pieces.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

constexpr double kGrowth = 1.5;
constexpr double kLoosest = 1000.0;  // largest growth after which the tolerance grows once more

double Lerp(double a, double b, double share) { return a + share * (b - a); }

double ShareOfTime(double from_s, double to_s, double at_s) {
  return to_s > from_s ? (at_s - from_s) / (to_s - from_s) : 1.0;
}

// Returns whether a moment must be kept whatever the tolerance.
bool IsMark(std::span<const ReplayPose> poses, std::size_t i) {
  if (i == 0 || i + 1 == poses.size() || poses[i].set_back || poses[i + 1].set_back) return true;
  return poses[i].sample.activity != poses[i + 1].sample.activity;
}

// The moments between two that are kept, both included.
using Part = std::pair<std::size_t, std::size_t>;

void KeepBetween(std::span<const ReplayPose> poses, const MotionTolerance& tolerance, Part whole,
                 std::vector<bool>& keep) {
  std::vector<Part> parts{whole};
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double worst = 1.0;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double error = ShownError(poses[first], poses[last], poses[i], tolerance);
      if (error <= worst) continue;
      worst = error;
      at = i;
    }
    if (at == first) continue;
    keep[at] = true;
    parts.emplace_back(first, at);
    parts.emplace_back(at, last);
  }
}

std::vector<std::size_t> Kept(std::span<const ReplayPose> poses, const MotionTolerance& tolerance) {
  std::vector<bool> keep(poses.size(), false);
  std::size_t before = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!IsMark(poses, i)) continue;
    keep[i] = true;
    KeepBetween(poses, tolerance, {before, i}, keep);
    before = i;
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

double JointError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  double share) {
  double worst_rad = 0.0;
  for (std::size_t i = 0; i < pose.joint_rad.size(); ++i) {
    const double shown_rad = Lerp(before.joint_rad[i], after.joint_rad[i], share);
    worst_rad = std::max(worst_rad, std::abs(pose.joint_rad[i] - shown_rad));
  }
  return worst_rad;
}

}  // namespace

double ShownError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  const MotionTolerance& tolerance) {
  const truth::TraceSample& a = before.sample;
  const truth::TraceSample& b = after.sample;
  const truth::TraceSample& now = pose.sample;
  const double share = ShareOfTime(a.time_s, b.time_s, now.time_s);
  const auto position = [](const truth::TraceSample& s) {
    return math::Vector3(s.posture.X_WR.translation());
  };
  const auto attitude = [](const truth::TraceSample& s) {
    return Eigen::Quaterniond(s.posture.X_WR.linear());
  };
  const double position_m =
      (position(a) + share * (position(b) - position(a)) - position(now)).norm();
  const double believed_m =
      std::hypot(Lerp(a.estimate.x_m, b.estimate.x_m, share) - now.estimate.x_m,
                 Lerp(a.estimate.y_m, b.estimate.y_m, share) - now.estimate.y_m);
  const double attitude_rad = attitude(a).slerp(share, attitude(b)).angularDistance(attitude(now));
  const double heading_rad =
      math::WrapAngle(now.estimate.heading_rad - a.estimate.heading_rad -
                      share * math::WrapAngle(b.estimate.heading_rad - a.estimate.heading_rad));
  return std::max({position_m / tolerance.position_m, believed_m / tolerance.position_m,
                   attitude_rad / tolerance.angle_rad, std::abs(heading_rad) / tolerance.angle_rad,
                   JointError(before, after, pose, share) / tolerance.joint_rad});
}

ThinnedMotion ThinMotion(std::span<const ReplayPose> poses, std::size_t most) {
  ThinnedMotion motion;
  for (double scale = 1.0;; scale *= kGrowth) {
    motion.tolerance = MotionTolerance{}.Scaled(scale);
    motion.kept = Kept(poses, motion.tolerance);
    if (motion.kept.size() <= most || scale > kLoosest) return motion;
  }
}

namespace {

using core::JsonList;
using core::JsonNumber;
using core::JsonObject;

// The activities in the order of the indices that a page holds. Must agree: the names of
// trial/drive/drive_tracer.cc. An activity that is missing here would be shown as the one before
// it.
constexpr std::array<std::string_view, 8> kActivities{"drive", "turn",  "steer",   "scan",
                                                      "stall", "image", "compute", "overhead"};

// How near to the last time, s, times have every digit; more than rounding moves a time.
constexpr double kNearEnd_s = 1e-3;

// Returns the attitudes as unit quaternions, each with the sign that is nearer to the one before.
std::vector<Eigen::Quaterniond> Attitudes(std::span<const ReplayPose> poses,
                                          std::span<const std::size_t> kept) {
  std::vector<Eigen::Quaterniond> attitudes;
  attitudes.reserve(kept.size());
  for (const std::size_t i : kept) {
    Eigen::Quaterniond q(poses[i].sample.posture.X_WR.linear());
    if (!attitudes.empty() && q.dot(attitudes.back()) < 0.0) q.coeffs() *= -1.0;
    attitudes.push_back(q);
  }
  return attitudes;
}

// Returns the index of each moment's activity. A moment without an activity gets that of the moment
// before; the start, which has none before it, gets the first of kActivities.
std::string ActivityText(std::span<const ReplayPose> poses, std::span<const std::size_t> kept) {
  std::size_t now = 0;
  return JsonList(kept, [&](std::size_t i) {
    const auto found = std::find(kActivities.begin(), kActivities.end(), poses[i].sample.activity);
    if (found != kActivities.end()) now = static_cast<std::size_t>(found - kActivities.begin());
    return std::to_string(now);
  });
}

std::string BreaksText(std::span<const ReplayPose> poses, std::span<const std::size_t> kept) {
  std::vector<std::size_t> breaks;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (poses[kept[k]].set_back) breaks.push_back(k);
  }
  return JsonList(breaks, [](std::size_t k) { return std::to_string(k); });
}

// Writes lists of one number for each kept moment; the last number has every digit.
class Channels {
 public:
  Channels(std::span<const ReplayPose> poses, std::span<const std::size_t> kept)
      : poses_(poses), kept_(kept) {}

  // Returns the time of the last moment, s; 0 where a fault came before the first one.
  double last_s() const { return kept_.empty() ? 0.0 : poses_[kept_.back()].sample.time_s; }

  template <typename Value, typename Text>
  std::string Of(const Value& value, const Text& text) const {
    std::size_t left = kept_.size();
    return JsonList(kept_, [&](std::size_t i) {
      const double number = value(poses_[i]);
      return --left == 0 ? JsonNumber(number) : text(number);
    });
  }

 private:
  std::span<const ReplayPose> poses_;
  std::span<const std::size_t> kept_;
};

std::string JointsText(std::span<const ReplayLink> links, const Channels& channels) {
  JsonObject joints;
  for (std::size_t link = 1; link < links.size(); ++link) {
    joints.Add(links[link].name,
               channels.Of([link](const ReplayPose& p) { return p.joint_rad[link - 1]; }, Angle));
  }
  return joints.Text();
}

void AddTruePose(const Channels& channels, JsonObject& object) {
  const auto position = [&](Eigen::Index axis) {
    return channels.Of(
        [axis](const ReplayPose& p) { return p.sample.posture.X_WR.translation()[axis]; }, Length);
  };
  // The last time has every digit. Times near it have, too, or rounding could move one beyond it.
  const double last_s = channels.last_s();
  const auto time = [last_s](double time_s) {
    return time_s > last_s - kNearEnd_s ? JsonNumber(time_s) : Length(time_s);
  };
  object.Add("t", channels.Of([](const ReplayPose& p) { return p.sample.time_s; }, time))
      .Add("x", position(0))
      .Add("y", position(1))
      .Add("z", position(2));
}

void AddAttitudes(const std::vector<Eigen::Quaterniond>& attitudes, JsonObject& object) {
  const auto part = [&](const auto& value) {
    std::size_t left = attitudes.size();
    return JsonList(attitudes, [&](const Eigen::Quaterniond& q) {
      return --left == 0 ? JsonNumber(value(q)) : Angle(value(q));
    });
  };
  object.Add("qw", part([](const Eigen::Quaterniond& q) { return q.w(); }))
      .Add("qx", part([](const Eigen::Quaterniond& q) { return q.x(); }))
      .Add("qy", part([](const Eigen::Quaterniond& q) { return q.y(); }))
      .Add("qz", part([](const Eigen::Quaterniond& q) { return q.z(); }));
}

void AddBelief(const Channels& channels, JsonObject& object) {
  object
      .Add("believed_x",
           channels.Of([](const ReplayPose& p) { return p.sample.estimate.x_m; }, Length))
      .Add("believed_y",
           channels.Of([](const ReplayPose& p) { return p.sample.estimate.y_m; }, Length))
      .Add("believed_heading",
           channels.Of([](const ReplayPose& p) { return p.sample.estimate.heading_rad; }, Angle))
      .Add("tilt", channels.Of([](const ReplayPose& p) { return p.sample.tilt_rad; }, Angle));
}

}  // namespace

std::string MotionJson(std::span<const ReplayLink> links, std::span<const ReplayPose> poses) {
  const ThinnedMotion motion = ThinMotion(poses);
  const Channels channels(poses, motion.kept);
  JsonObject object;
  AddTruePose(channels, object);
  AddAttitudes(Attitudes(poses, motion.kept), object);
  object.Add("joints", JointsText(links, channels));
  AddBelief(channels, object);
  object.Add("activity", ActivityText(poses, motion.kept))
      .Add("activity_names", JsonList(kActivities, core::QuoteJson))
      .Add("breaks", BreaksText(poses, motion.kept))
      .AddNumber("position_tolerance", motion.tolerance.position_m)
      .AddNumber("angle_tolerance", motion.tolerance.angle_rad);
  return object.Text();
}

}  // namespace rockyard::replay
