#include "campaign/odometry/render_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "campaign/odometry/pose_text.h"
#include "core/check.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "image_files/png_file.h"
#include "math/functions.h"
#include "report/result_table.h"
#include "scenario/load.h"
#include "sensing/stereo_imager.h"
#include "trial/course/route_planner.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {
namespace {

using math::Pose2;

// Returns the mask as an image that people can look at.
vision::GrayImage MaskPicture(const vision::Image<std::uint8_t>& free) {
  vision::GrayImage picture(free.width(), free.height());
  std::transform(
      free.values().begin(), free.values().end(), picture.values().begin(),
      [](std::uint8_t value) { return value == 0 ? std::uint8_t{0} : std::uint8_t{255}; });
  return picture;
}

std::vector<math::Pose2> PlannedWay(const SequenceRequest& request, const RenderStage& stage) {
  const trial::DriveParams& drive = stage.scenario().drive;
  const math::Pose2 first = FirstPose(request.scene, drive.course.Start());
  if (request.way == SequenceWay::kCircle) {
    return CircleWay(first, request.pairs, request.step_m, request.turn_rad);
  }
  const messages::Goal goal{drive.course.goal_x_m, drive.course.goal_y_m};
  const messages::Route route = trial::PlanRoute(drive, stage.terrain().rocks(), goal);
  if (route.corners.empty()) {
    throw core::UserError("--route", "there is no way to the goal among the rocks of this trial",
                          "choose another --trial, or leave --route out");
  }
  return CornerWay(drive.course.Start(), route.corners, request.pairs, request.step_m,
                   request.turn_rad);
}

// Throws where the way leaves the arena: images from beyond it show rocks that nobody placed.
void CheckArena(const std::vector<math::Pose2>& way, const terrain::ArenaParams& arena) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    const bool inside = way[i].x_m >= arena.x_min_m &&
                        way[i].x_m <= arena.x_min_m + arena.length_m &&
                        std::abs(way[i].y_m) <= 0.5 * arena.width_m;
    if (inside) continue;
    throw core::UserError(
        "--pairs",
        fmt::format("pair {} is taken at x {:.2f} m, y {:.2f} m, outside of the arena", i,
                    way[i].x_m, way[i].y_m),
        "take fewer or shorter steps, or make the arena larger (--set terrain.arena.length_m=...)");
  }
}

// Returns the poses by wheels: from the identity, the commanded steps one after the other, each in
// the true attitude.
std::vector<math::Transform> PosesByWheels(const std::vector<math::Pose2>& way,
                                           const std::vector<math::Transform>& truth, double slip) {
  const auto level = [](const math::Pose2& pose) {
    return math::MakePose({pose.x_m, pose.y_m, 0.0}, pose.heading_rad, 0.0, 0.0);
  };
  std::vector<math::Transform> poses;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i == 0) {
      poses.push_back(math::Transform::Identity());
      continue;
    }
    math::Transform step = math::Transform::Identity();
    step.linear() = truth[i - 1].linear().transpose() * truth[i].linear();
    step.translation() = (level(way[i - 1]).inverse() * level(way[i])).translation() / (1.0 - slip);
    poses.push_back(poses.back() * step);
  }
  return poses;
}

// Returns all that decides what is rendered. Must name every such setting: one that is left out may
// differ when a sequence is gone on with, and nobody notices.
core::JsonValue SequenceRequestJson(const SequenceRequest& request, const RenderStage& stage) {
  const RenderRequest& scene = request.scene;
  const auto number = [](const std::optional<double>& value) {
    return value ? core::JsonValue(*value) : core::JsonValue();
  };
  return report::ObjectTree(
      "scenario", core::Hex(scenario::Fingerprint(stage.scenario())), "seed",
      std::to_string(scene.seed.value_or(stage.scenario().seed)), "trial", scene.trial, "ahead",
      scene.direction == messages::LookDirection::kAhead, "route",
      request.way == SequenceWay::kRoute, "pairs", request.pairs, "step_m", request.step_m,
      "turn_rad", request.turn_rad, "period_s", request.period_s, "slip", request.slip, "x_m",
      number(scene.x_m), "y_m", number(scene.y_m), "heading_rad", number(scene.heading_rad));
}

// The folder of a sequence. Pairs of images go into it as they are taken, all else when they are
// there.
class SequenceFolder {
 public:
  SequenceFolder(const SequenceRequest& request, const RenderStage& stage)
      : top_(request.scene.out, request.scene.existing,
             {.command = "render",
              .names = {"left", "right", "cameras.json", "left_free.png", "right_free.png",
                        "poses.txt", "wheels.txt", "times.txt"},
              .inputs = {request.scene.scenario},
              .request = SequenceRequestJson(request, stage)}) {}

  bool HoldsPair(std::int64_t number) const {
    return top_.resumes() && std::filesystem::exists(top_.PathOf(NameOf("left", number))) &&
           std::filesystem::exists(top_.PathOf(NameOf("right", number)));
  }

  void WritePair(std::int64_t number, const sensing::StereoImages& images) {
    top_.WriteNow(NameOf("left", number), image_files::EncodePng(images.left));
    top_.WriteNow(NameOf("right", number), image_files::EncodePng(images.right));
  }

  void WriteRig(const vision::StereoRig& rig) {
    top_.Write("cameras", "cameras.json",
               core::DumpJson(vision::CameraPairJson({rig.left, rig.right})) + "\n");
    top_.Write("left_free", "left_free.png", image_files::EncodePng(MaskPicture(rig.left_free)));
    top_.Write("right_free", "right_free.png", image_files::EncodePng(MaskPicture(rig.right_free)));
  }

  void WriteTruth(const std::vector<math::Transform>& poses,
                  const std::vector<math::Transform>& wheels, double period_s) {
    std::vector<double> times_s;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      times_s.push_back(period_s * static_cast<double>(i));
    }
    top_.Write("poses", "poses.txt", KittiPoses(poses));
    top_.Write("wheels", "wheels.txt", KittiPoses(wheels));
    top_.Write("times", "times.txt", TimesText(times_s));
  }

  const std::vector<OutputFile>& Finish(bool all) {
    top_.Finish(all);
    return top_.files();
  }

 private:
  static std::string NameOf(std::string_view eye, std::int64_t number) {
    return fmt::format("{}/{}", eye, SequenceImageName(number));
  }

  OutputFolder top_;
};

constexpr double kSamePlace_m = 1e-3;
// Below this turn the chord of a circle is its arc, to every digit.
constexpr double kNoTurn_rad = 1e-9;
// Quotients of lengths or angles that are off a whole number by less are whole but for rounding.
constexpr double kRounding = 1e-9;

Pose2 OnCircle(const Pose2& from, double step_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  const double chord_m =
      std::abs(half_rad) < kNoTurn_rad ? step_m : step_m * math::Sin(half_rad) / half_rad;
  const double along_rad = from.heading_rad + half_rad;
  return {from.x_m + chord_m * math::Cos(along_rad), from.y_m + chord_m * math::Sin(along_rad),
          from.heading_rad + turn_rad};
}

// Returns the number of parts, at most `most`: it may be larger than any integer.
std::int64_t PartsOf(double parts, std::int64_t most) {
  return static_cast<std::int64_t>(std::min(parts, static_cast<double>(most)));
}

}  // namespace

std::string SequenceImageName(std::int64_t number) { return fmt::format("{:06}.png", number); }

SequenceResult RenderSequence(const SequenceRequest& request, const SequenceProgress& progress,
                              const Stop& stop) {
  RenderStage stage(request.scene);
  const std::vector<math::Pose2> way = PlannedWay(request, stage);
  CheckArena(way, stage.scenario().drive.terrain.arena);
  const vision::StereoRig rig = stage.CalibratedRig(request.scene.direction);
  SequenceResult result;
  result.planned = std::ssize(way);
  result.size = rig.left.size;
  SequenceFolder folder(request, stage);
  const StopWish wish(stop);
  std::vector<math::Transform> poses;
  for (const math::Pose2& place : way) {
    if (wish.IsThere()) {
      result.outcome = Outcome::kInterrupted;
      break;
    }
    const math::Transform& X_WR = stage.Stand(place);
    if (!folder.HoldsPair(result.pairs)) {
      folder.WritePair(result.pairs, stage.imager().Expose(stage.terrain(), X_WR, result.pairs,
                                                           request.scene.direction));
    }
    if (!poses.empty()) {
      result.distance_m += (X_WR.translation() - poses.back().translation()).norm();
    }
    poses.push_back(X_WR);
    ++result.pairs;
    if (progress) progress(result.pairs, result.planned);
  }
  folder.WriteRig(rig);
  folder.WriteTruth(poses, PosesByWheels(way, poses, request.slip), request.period_s);
  result.files = folder.Finish(result.outcome == Outcome::kDone);
  return result;
}

std::vector<Pose2> CircleWay(const Pose2& start, std::int64_t count, double step_m,
                             double turn_rad) {
  EXPECT(count >= 1);
  std::vector<Pose2> way{start};
  way.reserve(static_cast<std::size_t>(count));
  while (std::ssize(way) < count) way.push_back(OnCircle(way.back(), step_m, turn_rad));
  return way;
}

std::vector<Pose2> CornerWay(const Pose2& start, std::span<const messages::Goal> corners,
                             std::int64_t count, double step_m, double turn_rad) {
  EXPECT(count >= 1 && step_m > 0.0 && turn_rad > 0.0);
  std::vector<Pose2> way{start};
  for (const messages::Goal& corner : corners) {
    if (std::ssize(way) >= count) break;
    const Pose2 from = way.back();
    const double distance_m = math::Hypot(corner.x_m - from.x_m, corner.y_m - from.y_m);
    if (distance_m < kSamePlace_m) continue;
    const double heading_rad = math::Atan2(corner.y_m - from.y_m, corner.x_m - from.x_m);
    const double turn = math::WrapAngle(heading_rad - from.heading_rad);
    const double turns = std::ceil(std::abs(turn) / turn_rad - kRounding);
    for (std::int64_t i = 1; i <= PartsOf(turns, count); ++i) {
      way.push_back({from.x_m, from.y_m, from.heading_rad + turn * static_cast<double>(i) / turns});
    }
    const std::int64_t steps = PartsOf(std::ceil(distance_m / step_m - kRounding), count);
    for (std::int64_t i = 1; i <= steps; ++i) {
      const double share = std::min(1.0, static_cast<double>(i) * step_m / distance_m);
      way.push_back({from.x_m + share * (corner.x_m - from.x_m),
                     from.y_m + share * (corner.y_m - from.y_m), heading_rad});
    }
  }
  if (std::ssize(way) > count) way.resize(static_cast<std::size_t>(count));
  return way;
}

}  // namespace rockyard::campaign
