// An arc planner in the manner of ENav, with the checks of ACE (clearance.h). After each look it
// follows candidate motions over the map, judges each pose on them, and drives the first part of
// the cheapest whose first part is safe. arc_planner.py is the same algorithm as a process: it
// decides the same, bit for bit.
//
// ENav's tree has turns in place, then arcs, then arcs. Here are arcs from where the rover stands,
// and turns in place with the straight way after them: a goal abeam needs a turn, a rock an arc.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "clearance.h"
#include "plugin/navigator_plugin.h"
#include "stop_and_look.h"

namespace {

using namespace examples;
using core::Assumed;
using core::Published;

struct ArcPlannerParams {
  CycleParams cycle;
  ClearanceParams clearance;
  std::int64_t arcs = 11;
  double max_curvature_per_m = 1.0;
  double arc_m = 1.5;
  double check_m = 0.15;
  double step_m = 0.45;
  double margin_weight_m = 0.5;
  double unknown_weight_m = 0.5;
  double turn_weight_m_per_rad = 0.3;

  void Visit(core::FieldVisitor& v) {
    cycle.Visit(v);
    clearance.Visit(v);
    v.Integer("arcs", arcs,
              Published("arcs to choose from", "11 in a layer of ENav", {2.0, 101.0}));
    v.Real("max_curvature_per_m", max_curvature_per_m,
           Assumed("curvature of the tightest arcs", "a circle three rover lengths wide",
                   {0.0, 5.0}, {0.5, 2.0}));
    v.Real("arc_m", arc_m,
           Assumed("how far motions are followed over the map", "as far as a small rover sees well",
                   {0.1, 10.0}, {1.0, 3.0}));
    v.Real("check_m", check_m,
           Assumed("way from one judged pose to the next",
                   "a quarter of a small rover's length; ENav: 0.25 m", {0.02, 1.0}, {0.1, 0.25}));
    v.Real("step_m", step_m,
           Assumed("how far it drives between two looks", "a third of an arc, as ENav", {0.02, 5.0},
                   {0.3, 1.0}));
    v.Real("margin_weight_m", margin_weight_m,
           Assumed("detour that a pose at its limits is worth", "a small rover's length",
                   {0.0, 10.0}, {0.0, 1.0}));
    v.Real("unknown_weight_m", unknown_weight_m,
           Assumed("detour that a way over unseen ground is worth", "a pose at its limits",
                   {0.0, 10.0}, {0.0, 1.0}));
    v.Real("turn_weight_m_per_rad", turn_weight_m_per_rad,
           Assumed("detour that a turn in place is worth", "turning takes time, and slips",
                   {0.0, 10.0}, {0.1, 1.0}));
  }
};

/// A motion among which the planner chooses.
struct Candidate {
  Move move;
  std::vector<Pose> path;  // as far as it is safe
  bool safe = false;
  double cost_m = 0.0;  // way to the goal that is left, and what detours it is worth to avoid
};

constexpr int kTurns = 5;  // to either side
constexpr double kTurn_rad = std::numbers::pi / 6.0;
constexpr int kSearch = 12;  // turns all round
// Counted by hand for a wheel: some nine cells, and its share of levers and belly.
constexpr double kOpsPerPlacement = 400.0;

class ArcPlanner final : public StopAndLook {
 public:
  ArcPlanner(const ArcPlannerParams& params, const navigation::NavigatorSetup& setup)
      : StopAndLook(params.cycle, setup), params_(params), clearance_(params.clearance, rover_) {
    own_ = {0.0, 0.0};
  }

 private:
  Move Plan(const Pose& here, const Pose& goal) override {
    const std::int64_t placed = clearance_.placements();
    candidates_.clear();
    for (std::int64_t i = 0; i < params_.arcs; ++i) {  // from right to left
      const double share = 2.0 * static_cast<double>(i) / static_cast<double>(params_.arcs - 1);
      candidates_.push_back(Follow(here, goal, 0.0, params_.max_curvature_per_m * (share - 1.0)));
    }
    for (int i = 1; i <= kTurns; ++i) {
      candidates_.push_back(Follow(here, goal, -kTurn_rad * i, 0.0));
      candidates_.push_back(Follow(here, goal, kTurn_rad * i, 0.0));
    }
    chosen_ = nullptr;
    own_[0] += 1.0;
    for (const Candidate& candidate : candidates_) {
      if (!candidate.safe) {
        own_[1] += 1.0;
      } else if (chosen_ == nullptr || candidate.cost_m < chosen_->cost_m) {
        chosen_ = &candidate;
      }
    }
    Move move;
    if (chosen_ != nullptr) {
      move = chosen_->move;
      searched_ = 0;
    } else if (++searched_ < kSearch) {
      move.turn_rad = kTurn_rad;  // nothing that it knows is safe: it looks about
    }
    move.work_ops = kOpsPerPlacement * static_cast<double>(clearance_.placements() - placed);
    return move;
  }

  /// Follows a motion over the map, to the first pose that is unsafe.
  Candidate Follow(const Pose& here, const Pose& goal, double turn_rad, double curvature_per_m) {
    const double goal_m = Length(goal.x_m - here.x_m, goal.y_m - here.y_m);
    const int checks = Checks(std::min(params_.arc_m, goal_m));
    const double bend_rad = params_.check_m * curvature_per_m;
    Candidate candidate{.move = {.turn_rad = turn_rad,
                                 .curvature_per_m = curvature_per_m,
                                 .way_m = std::min(params_.step_m, goal_m)},
                        .path = {here}};
    Pose at{here.x_m, here.y_m, here.heading_rad + turn_rad};
    int safe = 0, unknown = 0;
    double use = 0.0;
    for (; safe < checks; ++safe) {
      const Pose middle{at.x_m, at.y_m, at.heading_rad + 0.5 * bend_rad};
      const double heading_rad = at.heading_rad + bend_rad;
      at = Beside(middle, params_.check_m, 0.0);
      at.heading_rad = heading_rad;
      const Judgement pose = clearance_.Judge(map_, at);
      if (pose.use > 1.0) break;
      use = std::max(use, pose.use);
      if (!pose.known) ++unknown;
      candidate.path.push_back(at);
    }
    const Pose& end = candidate.path.back();
    candidate.safe = safe >= std::min(checks, Checks(params_.step_m));
    candidate.cost_m = Length(goal.x_m - end.x_m, goal.y_m - end.y_m) +
                       params_.margin_weight_m * use + params_.unknown_weight_m * unknown / checks +
                       params_.turn_weight_m_per_rad * std::abs(turn_rad);
    return candidate;
  }
  int Checks(double way_m) const {
    return std::max(1, static_cast<int>(std::floor(way_m / params_.check_m)));
  }

  void OnOtherWay() override { searched_ = 0; }

  void Show(messages::Overlay& overlay) const override {
    for (const Candidate& candidate : candidates_) {
      messages::OverlayLine line;
      line.name = &candidate == chosen_ ? "path" : candidate.safe ? "safe motion" : "unsafe motion";
      for (const Pose& pose : candidate.path) line.points.push_back(Told(pose));
      overlay.lines.push_back(std::move(line));
    }
    ShowSteps(rover_.belly_clearance_m, overlay);
  }

  const ArcPlannerParams params_;
  Clearance clearance_;
  std::vector<Candidate> candidates_;  // of the last plan
  const Candidate* chosen_ = nullptr;  // among them
  int searched_ = 0;                   // plans in succession that found nothing safe
};

navigation::NavigatorDescription<ArcPlannerParams> DescribeArcPlanner() {
  return {.name = "arc_planner",
          .doc = "an arc planner in the manner of ENav, with the checks of ACE",
          .traits = [](const ArcPlannerParams& params) { return params.cycle.Traits(); },
          .make = [](const ArcPlannerParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<ArcPlanner>(params, setup);
          },
          .own_values = {{"plans", "1", "Plans that were made."},
                         {"unsafe_arcs", "1", "Candidate motions whose first part was unsafe."}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeArcPlanner)
