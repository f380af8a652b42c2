// Mirrored reports and poses give mirrored decisions, except where the rules prefer the right.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

// Patterns, stripes from left to right, whose mirror image does not lead to the mirrored turn.
std::set<std::string> AsymmetricPatterns(const PathfinderParams& params, double bearing_rad) {
  std::set<std::string> asymmetric;
  for (unsigned pattern = 1; pattern < 32; ++pattern) {
    messages::HazardReport report;
    std::string name;
    for (std::size_t i = 0; i < messages::kStripes; ++i) {
      report.stripe_hazard[i] = ((pattern >> (messages::kStripes - 1 - i)) & 1u) != 0;
      name += report.stripe_hazard[i] ? '1' : '0';
    }
    messages::HazardReport mirrored = report;
    mirrored.stripe_hazard = Mirrored(report.stripe_hazard);
    if (ChooseTurn(report, bearing_rad, params) != -ChooseTurn(mirrored, -bearing_rad, params)) {
      asymmetric.insert(name);
    }
  }
  return asymmetric;
}

// Hazards on both sides, with equally many stripes, and with any numbers.
const std::set<std::string> kTies = {"01001", "01010", "01101", "01110", "10001",
                                     "10010", "10101", "10110", "11011", "11111"};
const std::set<std::string> kUnequal = {"01011", "01111", "10011", "10111",
                                        "11001", "11010", "11101", "11110"};

std::set<std::string> Union(std::set<std::string> a, const std::set<std::string>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

TEST(Mirror, OnlyTheCentreRuleAndTheOrderOfTheRulesPreferTheRight) {
  PathfinderParams params;
  const std::set<std::string> centre = {"00100"};
  // A centre hazard with an inner right hazard is also passed on the right, as is its mirror image.
  const std::set<std::string> centre_outermost = {"00100", "00110", "01100"};
  for (const double bearing_rad : {-0.5, 0.5}) {
    params.right_is_clear = RightIsClear::kNoRightHazard;
    params.both_sides = BothSidesReaction::kTowardGoal;
    EXPECT_EQ(AsymmetricPatterns(params, bearing_rad), centre);
    params.both_sides = BothSidesReaction::kFewerHazards;
    EXPECT_EQ(AsymmetricPatterns(params, bearing_rad), Union(centre, kTies));
    params.both_sides = BothSidesReaction::kRuleOrder;
    EXPECT_EQ(AsymmetricPatterns(params, bearing_rad), Union(Union(centre, kTies), kUnequal));

    params.right_is_clear = RightIsClear::kOutermostClear;
    params.both_sides = BothSidesReaction::kTowardGoal;
    EXPECT_EQ(AsymmetricPatterns(params, bearing_rad), centre_outermost);
  }
}

void ExpectMirrored(const Tick& a, const Tick& b) {
  EXPECT_EQ(a.decision.status, b.decision.status);
  EXPECT_EQ(a.decision.looks(), b.decision.looks());
  EXPECT_NEAR(a.X_WR.x_m, b.X_WR.x_m, 1e-9);
  EXPECT_NEAR(a.X_WR.y_m, -b.X_WR.y_m, 1e-9);
  if (a.decision.looks()) return;
  EXPECT_EQ(a.decision.motion.kind, b.decision.motion.kind);
  EXPECT_NEAR(a.decision.motion.curvature_per_m, -b.decision.motion.curvature_per_m, 1e-12);
  const bool turns = a.decision.motion.kind == messages::MotionKind::kTurnInPlace;
  EXPECT_EQ(a.decision.motion.direction, (turns ? -1 : 1) * b.decision.motion.direction);
}

TEST(Mirror, WholeDrivesMirrorWithHazardsOnOneSideAtATime) {
  for (const double clear_m : {0.0, 0.15}) {
    for (const double heading_deg : {0.0, 25.0, 140.0}) {
      DriveSetup setup;
      setup.params.clear_distance_m = clear_m;
      setup.start = {0.0, 0.31, math::DegToRad(heading_deg)};
      const std::vector<Stripes> reports = {kClear, kLeftHazard, kLeftHazard,  kClear,
                                            kClear, kClear,      kRightHazard, kLeftHazard};
      setup.hazards = Sequence(reports);
      DriveSetup mirrored = setup;
      mirrored.start = {0.0, -0.31, math::DegToRad(-heading_deg)};
      std::vector<Stripes> mirrored_reports;
      for (const Stripes& stripes : reports) mirrored_reports.push_back(Mirrored(stripes));
      mirrored.hazards = Sequence(mirrored_reports);

      Drive a(setup);
      Drive b(mirrored);
      ASSERT_EQ(a.Run(), NavigatorStatus::kArrived);
      ASSERT_EQ(b.Run(), NavigatorStatus::kArrived);
      ASSERT_EQ(a.log().size(), b.log().size());
      for (std::size_t i = 0; i < a.log().size(); ++i) {
        SCOPED_TRACE(i);
        ExpectMirrored(a.log()[i], b.log()[i]);
        if (HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::navigation
