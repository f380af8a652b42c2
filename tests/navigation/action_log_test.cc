// What is recorded of a navigator comes back bit for bit, and nothing else passes for a log.
#include "navigation/action_log.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "navigation/navigator_fault.h"

namespace rockyard::navigation {
namespace {

constexpr std::uint64_t kSeed = 77;

// Numbers that a careless form would change, and any others.
double Number(core::RandomStream& random) {
  switch (random.NextU32() % 5) {
    case 0:
      return -0.0;
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return 0.0;
    default:
      return std::ldexp(static_cast<double>(random.NextU32()), -20) - 1000.0;
  }
}

std::vector<NavigatorDecision> SomeDecisions(std::size_t count) {
  core::RandomStream random({1, 2}, core::Purpose::kExperiment);
  std::vector<NavigatorDecision> decisions;
  while (decisions.size() < count) {
    if (!decisions.empty() && random.NextU32() % 3 == 0) {
      decisions.push_back(decisions.back());
      continue;
    }
    NavigatorDecision decision;
    decision.status = static_cast<NavigatorStatus>(random.NextU32() % 4);
    if (random.NextU32() % 2 == 0)
      decision.look = static_cast<messages::LookDirection>(random.NextU32() % 2);
    decision.looks_on_the_move = random.NextU32() % 2 == 0;
    decision.motion = {.kind = static_cast<messages::MotionKind>(random.NextU32() % 3),
                       .curvature_per_m = Number(random),
                       .direction = random.NextU32() % 2 == 0 ? 1 : -1,
                       .curvature_rate_per_m2 = Number(random),
                       .speed_share = Number(random),
                       .end_m = Number(random),
                       .move = static_cast<std::int64_t>(random.NextU64())};
    decision.until = {Number(random), Number(random), Number(random), Number(random)};
    decision.work_ops = Number(random);
    decisions.push_back(decision);
  }
  return decisions;
}

// Every member, bit for bit.
std::vector<std::uint64_t> Bits(const NavigatorDecision& decision) {
  const messages::MotionCommand& motion = decision.motion;
  std::vector<std::uint64_t> bits{
      static_cast<std::uint64_t>(decision.status),
      decision.look ? 1 + static_cast<std::uint64_t>(*decision.look) : 0,
      decision.looks_on_the_move,
      static_cast<std::uint64_t>(motion.kind),
      static_cast<std::uint64_t>(motion.direction),
      static_cast<std::uint64_t>(motion.move)};
  for (const double value :
       {motion.curvature_per_m, motion.curvature_rate_per_m2, motion.speed_share, motion.end_m,
        decision.until.period_s, decision.until.distance_m, decision.until.turn_rad,
        decision.until.near_goal_m, decision.work_ops}) {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

class Scripted final : public Navigator {
 public:
  NavigatorDecision Decide(const NavigatorInput&) override { return decisions_.at(next_++); }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, GoalChange) override {}
  const messages::NavigationView* view() const override { return &view_; }
  PlanCounts plan_counts() const override { return {4, 3, 2, 1, 0.125}; }
  std::span<const double> own_values() const override { return values_; }

 private:
  std::vector<NavigatorDecision> decisions_ = SomeDecisions(300);
  std::size_t next_ = 0;
  messages::NavigationView view_;
  std::vector<double> values_{1.5, -0.0};
};

NavigatorSet ScriptedSet() {
  NavigatorSet set;
  set.Add(NavigatorDescription<core::NoParams>{
      .name = "scripted",
      .doc = "",
      .traits =
          [](const core::NoParams&) {
            return NavigatorTraits(LookReading::kNothing, CostOfLook{}, {});
          },
      .make = [](const core::NoParams&, const NavigatorSetup&) -> std::unique_ptr<Navigator> {
        return std::make_unique<Scripted>();
      }});
  return set;
}

// Returns the log of a drive with so many questions.
std::string LogOf(std::size_t questions) {
  std::string taken;
  NavigatorSet set = ScriptedSet();
  set.WrapChosen([&](std::unique_ptr<NavigatorKind> kind) {
    return Recorded(std::move(kind), [&](std::uint64_t random_seed, std::string log) {
      EXPECT_EQ(random_seed, kSeed);
      taken = std::move(log);
    });
  });
  {
    const auto navigator = set.chosen().Make({.goal = {}, .random_seed = kSeed});
    for (std::size_t i = 0; i < questions; ++i) navigator->Decide({});
  }
  return taken;
}

std::unique_ptr<Navigator> PlayerOf(const std::string& log) {
  NavigatorSet set = ScriptedSet();
  set.WrapChosen([&](std::unique_ptr<NavigatorKind> kind) {
    return Played(std::move(kind), [log](std::uint64_t) { return log; });
  });
  EXPECT_EQ(set.chosen().name(), "scripted");
  return set.chosen().Make({.goal = {}, .random_seed = kSeed});
}

TEST(ActionLog, AnswersComeBackBitForBit) {
  const std::vector<NavigatorDecision> decisions = SomeDecisions(300);
  const auto player = PlayerOf(LogOf(300));
  for (const NavigatorDecision& decision : decisions) {
    EXPECT_EQ(Bits(player->Decide({})), Bits(decision));
  }
  EXPECT_EQ(player->plan_counts().late, 2);
  EXPECT_EQ(player->plan_counts().start_error_squared_m2, 0.125);
  ASSERT_EQ(player->own_values().size(), 2u);
  EXPECT_TRUE(std::signbit(player->own_values()[1]));
  EXPECT_NE(player->view(), nullptr);
  EXPECT_THROW(player->Decide({}), NavigatorFault) << "there is no further answer";
}

TEST(ActionLog, WhatIsCutOffOrTooLongIsNoLog) {
  const std::string log = LogOf(5);
  const auto play = [](const std::string& text) {
    const auto player = PlayerOf(text);
    for (int i = 0; i < 5; ++i) player->Decide({});
  };
  EXPECT_NO_THROW(play(log));
  for (std::size_t size = 0; size < log.size(); ++size) {
    EXPECT_THROW(play(log.substr(0, size)), NavigatorFault) << size;
  }
  EXPECT_THROW(play(log + 'x'), NavigatorFault);
  EXPECT_THROW(play('x' + log), NavigatorFault);
}

}  // namespace
}  // namespace rockyard::navigation
