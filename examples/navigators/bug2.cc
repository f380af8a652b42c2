// Bug2 (Lumelsky and Stepanov 1987): drive along the straight line from the start to the goal;
// where something stands in the way follow its wall, until the line is met again nearer to the goal
// than it was left; a rover that comes round to where it met the wall is shut out from its goal.
// The proof needs no map. A rover that only looks ahead needs a small one all the same: the wall
// that it follows lies beside it.
//
// The paper's point robot touches walls. Here a corridor as wide as the rover has to be free of
// steps that the belly would not pass, and following is a sweep: of all headings, beginning at the
// wall's side, the first free one is driven.
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "plugin/navigator_plugin.h"
#include "stop_and_look.h"

namespace {

using namespace examples;
using core::Assumed;
using core::Setting;

struct Bug2Params {
  CycleParams cycle;
  bool wall_on_right = true;
  double obstacle_share = 0.8;
  double margin_m = 0.1;
  double step_m = 0.3;
  double line_m = 0.15;
  double gain_m = 0.3;
  double round_m = 3.0;

  void Visit(core::FieldVisitor& v) {
    cycle.Visit(v);
    v.Boolean("wall_on_right", wall_on_right,
              Setting("whether it turns to the left where it meets a wall, with the wall on its "
                      "right",
                      {}, "the paper leaves the side open"));
    v.Real("obstacle_share", obstacle_share,
           Assumed("height of a wall, as a share of the belly's clearance",
                   "what the rover cannot straddle, less the noise of points", {0.05, 5.0},
                   {0.5, 1.0}));
    v.Real("margin_m", margin_m,
           Assumed("room on either side of the rover", "one cell of the map", {0.0, 1.0},
                   {0.05, 0.2}));
    v.Real("step_m", step_m,
           Assumed("how far it drives between two looks", "half of a small rover's length",
                   {0.02, 5.0}, {0.15, 0.5}));
    v.Real("line_m", line_m,
           Assumed("distance from the line at which it is on it", "half of a step", {0.01, 2.0},
                   {0.1, 0.3}));
    v.Real("gain_m", gain_m,
           Assumed("how much nearer to the goal the line has to be met again",
                   "a step; in the paper any gain counts, as nothing is noisy", {0.0, 5.0},
                   {0.1, 0.5}));
    v.Real("round_m", round_m,
           Assumed("way along a wall after which the place where it was met "
                   "counts as met again",
                   "round the smallest rock", {0.1, 100.0}, {2.0, 5.0}));
  }
};

constexpr double kSweep_rad = std::numbers::pi / 12.0;
constexpr int kHeadings = 24;

class Bug2 final : public StopAndLook {
 public:
  Bug2(const Bug2Params& params, const navigation::NavigatorSetup& setup)
      : StopAndLook(params.cycle, setup), params_(params) {
    own_ = {0.0};
  }

 private:
  Move Plan(const Pose& here, const Pose& goal) override {
    if (!started_) {
      start_ = last_ = here;
      started_ = true;
    }
    goal_ = goal;
    obstacles_ = map_.Obstacles(here.x_m, here.y_m, Reach_m() + params_.step_m,
                                params_.obstacle_share * rover_.belly_clearance_m);
    const double goal_m = Length(goal.x_m - here.x_m, goal.y_m - here.y_m);
    const double goal_rad = std::atan2(goal.y_m - here.y_m, goal.x_m - here.x_m);
    const double way_m = std::min(params_.step_m, goal_m);
    const bool free = IsFree(here, goal_rad, way_m);
    if (follows_) {
      followed_m_ += Length(here.x_m - last_.x_m, here.y_m - last_.y_m);
      if (free && IsOnLine(here) && goal_m < hit_goal_m_ - params_.gain_m) {
        follows_ = false;
      } else if (followed_m_ > params_.round_m &&
                 Length(here.x_m - hit_.x_m, here.y_m - hit_.y_m) < params_.step_m) {
        return {};  // round, and shut out
      }
    } else if (!free) {
      follows_ = true;
      hit_ = here;
      hit_goal_m_ = goal_m;
      followed_m_ = 0.0;
      along_rad_ = goal_rad + Away() * 0.5 * std::numbers::pi;  // the wall is ahead
      own_[0] += 1.0;
    }
    last_ = here;
    return follows_ ? Follow(here) : Towards(here, goal_rad, way_m);
  }

  /// Returns the first free heading, from the wall on.
  Move Follow(const Pose& here) {
    for (int i = 0; i < kHeadings; ++i) {
      const double heading_rad = along_rad_ + Away() * (i * kSweep_rad - 0.5 * std::numbers::pi);
      if (!IsFree(here, heading_rad, params_.step_m)) continue;
      const Move move = Towards(here, heading_rad, params_.step_m);
      // Sweeps begin at the way that was driven, not at a turn that a look may prove wrong.
      if (move.turn_rad == 0.0) along_rad_ = heading_rad;
      return move;
    }
    return {};  // walled in
  }

  /// Returns the sense of a turn away from the wall.
  double Away() const { return params_.wall_on_right ? 1.0 : -1.0; }
  double Reach_m() const { return 0.5 * rover_.length_m + params_.margin_m; }
  /// Returns whether the rover has room along a way straight ahead.
  bool IsFree(const Pose& here, double heading_rad, double way_m) const {
    const double c = std::cos(heading_rad), s = std::sin(heading_rad);
    const double side_m = 0.5 * rover_.width_m + params_.margin_m;
    for (const Place& obstacle : obstacles_) {
      const double dx_m = obstacle.x_m - here.x_m, dy_m = obstacle.y_m - here.y_m;
      const double ahead_m = c * dx_m + s * dy_m, left_m = c * dy_m - s * dx_m;
      const bool beside = std::abs(left_m) > side_m;
      if (!beside && ahead_m > 0.0 && ahead_m < way_m + Reach_m()) return false;
    }
    return true;
  }

  /// Returns whether the line was met since the last plan.
  bool IsOnLine(const Pose& here) const {
    const double now_m = OffLine_m(here);
    return std::abs(now_m) < params_.line_m || now_m * OffLine_m(last_) < 0.0;
  }
  double OffLine_m(const Pose& at) const {
    const double x_m = goal_.x_m - start_.x_m, y_m = goal_.y_m - start_.y_m;
    const double length_m = Length(x_m, y_m);
    if (length_m <= 0.0) return 0.0;
    return (x_m * (at.y_m - start_.y_m) - y_m * (at.x_m - start_.x_m)) / length_m;
  }

  void OnOtherWay() override { started_ = follows_ = false; }

  void Show(messages::Overlay& overlay) const override {
    if (!started_) return;
    overlay.lines.push_back({.name = "line", .points = {Told(start_), Told(goal_)}});
    if (follows_) overlay.lines.push_back({.name = "met", .points = {Told(hit_), Told(last_)}});
    ShowSteps(params_.obstacle_share * rover_.belly_clearance_m, overlay);
  }

  const Bug2Params params_;
  bool started_ = false;
  Pose start_;  // of the line
  Pose goal_;   // its end
  Pose last_;   // at the last plan
  std::vector<Place> obstacles_;
  bool follows_ = false;
  Pose hit_;                 // where the wall was met
  double hit_goal_m_ = 0.0;  // from there to the goal
  double followed_m_ = 0.0;
  double along_rad_ = 0.0;  // heading of the last way along the wall
};

navigation::NavigatorDescription<Bug2Params> DescribeBug2() {
  return {.name = "bug2",
          .doc = "Bug2: along a line, and round what stands on it (Lumelsky and Stepanov 1987)",
          .traits = [](const Bug2Params& params) { return params.cycle.Traits(); },
          .make = [](const Bug2Params& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Bug2>(params, setup);
          },
          .own_values = {{"wall_followings", "1", "Walls that it met and followed."}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeBug2)
