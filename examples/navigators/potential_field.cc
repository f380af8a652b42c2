// A potential field (Khatib 1986): the goal pulls, obstacles push, and the rover goes where the sum
// points. Quick and smooth, and known for where it fails: in a local minimum pull and push cancel.
// The planner notices that it gets nowhere, counts it, and goes round with the pushes turned aside,
// or gives up.
//
// Khatib sums over obstacles, each by its nearest point. Here an obstacle is what is nearest in a
// sector of 15 degrees: a wall of many cells pushes no harder than one of few.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>

#include "plugin/navigator_plugin.h"
#include "stop_and_look.h"

namespace {
enum class OnMinimum { kGiveUp, kGoRound };
}  // namespace
template <>
struct rockyard::core::EnumNames<OnMinimum> {
  static constexpr std::array<std::string_view, 2> kNames{"give_up", "go_round"};
};

namespace {

using namespace examples;
using core::Assumed;
using core::Setting;

struct PotentialFieldParams {
  CycleParams cycle;
  double obstacle_share = 0.8;
  double influence_m = 1.0;
  double push_m3 = 0.04;
  double step_m = 0.3;
  double turn_above_rad = std::numbers::pi / 6.0;
  OnMinimum on_minimum = OnMinimum::kGoRound;
  double minimum_m = 0.4;
  std::int64_t minimum_plans = 6;
  std::int64_t round_plans = 12;

  void Visit(core::FieldVisitor& v) {
    cycle.Visit(v);
    v.Real("obstacle_share", obstacle_share,
           Assumed("height of an obstacle, as a share of the belly's clearance",
                   "what the rover cannot straddle, less the noise of points", {0.05, 5.0},
                   {0.5, 1.0}));
    v.Real("influence_m", influence_m,
           Assumed("distance from the rover's side up to which obstacles push",
                   "two small rovers' widths", {0.05, 10.0}, {0.5, 1.5}));
    v.Real("push_m3", push_m3,
           Assumed("strength of the push, where the goal pulls with 1",
                   "as strong as the pull at 0.3 m of one obstacle straight ahead", {0.0, 10.0},
                   {0.01, 0.1}));
    v.Real("step_m", step_m,
           Assumed("how far it drives between two looks", "half of a small rover's length",
                   {0.02, 5.0}, {0.15, 0.5}));
    v.Angle("turn_above_deg", turn_above_rad,
            Assumed("bearing of the sum above which it turns in place", "arcs swing wide",
                    {1.0, 180.0}, {15.0, 60.0}));
    v.Choice("on_minimum", on_minimum,
             Setting("what follows a local minimum: give_up, or go_round with turned pushes"));
    v.Real("minimum_m", minimum_m,
           Assumed("way that the last plans have to bring it on", "little more than a step",
                   {0.01, 5.0}, {0.2, 0.6}));
    v.Integer("minimum_plans", minimum_plans,
              Assumed("how many plans these are", "some turns and looks are no standstill",
                      {2.0, 100.0}, {4.0, 10.0}));
    v.Integer("round_plans", round_plans,
              Assumed("plans with turned pushes", "past a wall of three rover lengths",
                      {1.0, 1000.0}, {6.0, 30.0}));
  }
};

constexpr int kSectors = 24;

class PotentialField final : public StopAndLook {
 public:
  PotentialField(const PotentialFieldParams& params, const navigation::NavigatorSetup& setup)
      : StopAndLook(params.cycle, setup), params_(params) {
    own_ = {0.0};
  }

 private:
  Move Plan(const Pose& here, const Pose& goal) override {
    if (round_ > 0) {
      --round_;
    } else if (GetsNowhere(here)) {
      own_[0] += 1.0;
      if (params_.on_minimum == OnMinimum::kGiveUp) return {};
      round_ = params_.round_plans;
    }
    const double goal_rad = std::atan2(goal.y_m - here.y_m, goal.x_m - here.x_m);
    here_ = here;
    pull_ = {std::cos(goal_rad), std::sin(goal_rad)};
    push_ = Push(here);
    const double sum_rad = std::atan2(pull_.y_m + push_.y_m, pull_.x_m + push_.x_m);
    const double bearing_rad = Wrapped(sum_rad - here.heading_rad);
    if (std::abs(bearing_rad) > params_.turn_above_rad) return {.turn_rad = bearing_rad};
    const double way_m = std::min(params_.step_m, Length(goal.x_m - here.x_m, goal.y_m - here.y_m));
    return {.curvature_per_m = bearing_rad / way_m, .way_m = way_m};
  }

  /// Returns the sum of what obstacles push: the slope of Khatib's potential,
  /// push (1/d - 1/influence) / d^2, away from each of them.
  Place Push(const Pose& here) const {
    std::array<Place, kSectors> nearest{};
    std::array<double, kSectors> distance_m{};
    distance_m.fill(std::numeric_limits<double>::infinity());
    const double side_m = 0.5 * rover_.width_m;
    const double reach_m = side_m + params_.influence_m;
    for (const Place& place : map_.Obstacles(here.x_m, here.y_m, reach_m,
                                             params_.obstacle_share * rover_.belly_clearance_m)) {
      const Place off{place.x_m - here.x_m, place.y_m - here.y_m};
      const double off_m = Length(off.x_m, off.y_m);
      const double turn = 0.5 + 0.5 * std::atan2(off.y_m, off.x_m) / std::numbers::pi;  // 0 to 1
      const auto sector = static_cast<std::size_t>(std::min(kSectors - 1.0, kSectors * turn));
      if (off_m >= std::min(reach_m, distance_m[sector])) continue;
      distance_m[sector] = off_m;
      nearest[sector] = off;
    }
    Place sum;
    for (std::size_t i = 0; i < kSectors; ++i) {
      if (distance_m[i] > reach_m) continue;
      const double room_m = std::max(0.05, distance_m[i] - side_m);
      const double push =
          params_.push_m3 * (1.0 / room_m - 1.0 / params_.influence_m) / (room_m * room_m);
      Place away{-nearest[i].x_m / distance_m[i], -nearest[i].y_m / distance_m[i]};
      // On the way round all pushes are turned to the left by a right angle, so that none of them
      // points against the pull for good.
      if (round_ > 0) away = {-away.y_m, away.x_m};
      sum.x_m += push * away.x_m;
      sum.y_m += push * away.y_m;
    }
    return sum;
  }

  /// Returns whether the last plans have not brought the rover on.
  bool GetsNowhere(const Pose& here) {
    if (plans_++ % params_.minimum_plans != 0) return false;
    const double way_m = Length(here.x_m - anchor_.x_m, here.y_m - anchor_.y_m);
    anchor_ = here;
    return plans_ > 1 && way_m < params_.minimum_m;
  }

  void OnOtherWay() override { plans_ = round_ = 0; }

  void Show(messages::Overlay& overlay) const override {
    const auto arrow = [this](const Place& force) {
      return Told({here_.x_m + force.x_m, here_.y_m + force.y_m, 0.0});
    };
    overlay.lines.push_back({.name = "pull", .points = {Told(here_), arrow(pull_)}});
    overlay.lines.push_back({.name = "push", .points = {Told(here_), arrow(push_)}});
    ShowSteps(params_.obstacle_share * rover_.belly_clearance_m, overlay);
  }

  const PotentialFieldParams params_;
  Pose here_;               // at the last plan
  Place pull_, push_;       // what drew it there, in O
  std::int64_t round_ = 0;  // plans that still go round
  std::int64_t plans_ = 0;  // since the last other way
  Pose anchor_;             // some plans ago
};

navigation::NavigatorDescription<PotentialFieldParams> DescribePotentialField() {
  return {.name = "potential_field",
          .doc = "a potential field: the goal pulls, obstacles push (Khatib 1986)",
          .traits = [](const PotentialFieldParams& params) { return params.cycle.Traits(); },
          .make = [](const PotentialFieldParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<PotentialField>(params, setup);
          },
          .own_values = {{"local_minima", "1", "Places where it got nowhere."}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribePotentialField)
