// A plugin that does harm as it is told, for hostile_navigators.py: at the `at`-th question of a
// drive whose seed is divisible by `every`, what `harm` names.
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "plugin/navigator_plugin.h"

namespace {

namespace core = rockyard::core;
namespace messages = rockyard::messages;
namespace navigation = rockyard::navigation;

enum class Harm {
  kNone,
  kThrows,
  kThrowsInt,
  kCrashes,
  kAborts,
  kHangs,
  kNan,
  kNoDirection,
  kExits,
  kQuickExits,
  kForks,
  kPrints,
  kAllocates,
  kRecurses,
  kKillsItself,
};

}  // namespace

template <>
struct rockyard::core::EnumNames<Harm> {
  static constexpr std::array<std::string_view, 15> kNames{
      "none",  "throws", "throws_int",   "crashes",  "aborts",
      "hangs", "nan",    "no_direction", "exits",    "quick_exits",
      "forks", "prints", "allocates",    "recurses", "kills_itself"};
};

namespace {

struct HostileParams {
  double goal_tolerance_m = 0.3;
  Harm harm = Harm::kNone;
  std::int64_t at = 1;
  std::int64_t every = 3;

  void Visit(core::FieldVisitor& v) {
    v.Real("goal_tolerance_m", goal_tolerance_m, core::Setting("where it has arrived", {0.0, 5.0}));
    v.Choice("harm", harm, core::Setting("what it does"));
    v.Integer("at", at, core::Setting("at which question", {1, 1000}));
    v.Integer("every", every, core::Setting("in one of so many drives", {1, 1000}));
  }
};

volatile int sink = 0;

int Recurse(int depth) {
  volatile char space[4096] = {};
  space[0] = static_cast<char>(depth);
  return space[0] + (depth < 1'000'000'000 ? Recurse(depth + 1) : 0);
}

class Hostile final : public navigation::Navigator {
 public:
  Hostile(const HostileParams& params, const navigation::NavigatorSetup& setup)
      : params_(params),
        goal_(setup.goal),
        hostile_(setup.random_seed % static_cast<std::uint64_t>(params.every) == 0) {}

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    navigation::NavigatorDecision decision = Beeline(input);
    if (hostile_ && ++asked_ == params_.at) Do(decision);
    return decision;
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal& goal, navigation::GoalChange) override { goal_ = goal; }

 private:
  navigation::NavigatorDecision Beeline(const navigation::NavigatorInput& input) const {
    const double goal_m =
        std::hypot(goal_.x_m - input.estimate.x_m, goal_.y_m - input.estimate.y_m);
    if (goal_m <= params_.goal_tolerance_m) {
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    }
    navigation::Until until = navigation::AtEvents();
    until.distance_m = 0.2;
    return navigation::Move({.kind = messages::MotionKind::kArc}, until);
  }

  void Do(navigation::NavigatorDecision& decision) const {
    switch (params_.harm) {
      case Harm::kNone:
        return;
      case Harm::kThrows:
        throw std::runtime_error("as it was told");
      case Harm::kThrowsInt:
        throw 7;
      case Harm::kCrashes:
        *static_cast<volatile int*>(nullptr) = 1;
        return;
      case Harm::kAborts:
        std::abort();
      case Harm::kHangs:
        for (;;) sink = sink + 1;
      case Harm::kNan:
        decision.motion.curvature_per_m = std::numeric_limits<double>::quiet_NaN();
        return;
      case Harm::kNoDirection:
        decision.motion.direction = 0;
        return;
      case Harm::kExits:
        std::exit(0);
      case Harm::kQuickExits:
        _exit(3);
      case Harm::kForks:
        if (fork() == 0) return;  // the child goes on with the drive, if it is let
        return;
      case Harm::kPrints:
        for (int i = 0; i < 20000; ++i) std::puts("a plugin that prints");
        return;
      case Harm::kAllocates: {
        // Not touched whole: the machine is to live.
        std::vector<std::unique_ptr<char[]>> all;
        for (int i = 0; i < 10; ++i) all.emplace_back(new char[std::size_t{1} << 30]);
        sink = all.back()[0];
        return;
      }
      case Harm::kRecurses:
        sink = Recurse(0);
        return;
      case Harm::kKillsItself:
        kill(getpid(), 9);
        return;
    }
  }

  HostileParams params_;
  messages::Goal goal_;
  bool hostile_;
  std::int64_t asked_ = 0;
};

navigation::NavigatorDescription<HostileParams> DescribeHostile() {
  return {.name = "hostile",
          .doc = "does harm as it is told",
          .traits = [](const HostileParams& params) -> navigation::NavigatorTraits {
            return {navigation::LookReading::kNothing,
                    navigation::CostOfLook{},
                    {"goal_tolerance_m", params.goal_tolerance_m}};
          },
          .make = [](const HostileParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<Hostile>(params, setup);
          }};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeHostile)
