// The rules of Matthies 1995, section 7, as a truth table; and that mirrored reports and poses give
// mirrored decisions, except where the rules prefer the right.

#include <array>
#include <set>
#include <string_view>

#include "core/check.h"
#include "navigation/fake_rover.h"
#include "navigation/pathfinder/pathfinder.h"

namespace rockyard::navigation {
namespace {

// Stripes from left to right; '1' is a hazard.
messages::HazardReport Report(std::string_view stripes) {
  messages::HazardReport report;
  for (std::size_t i = 0; i < messages::kStripes; ++i) report.stripe_hazard[i] = stripes[i] == '1';
  return report;
}

// Turn for the default stripe groups (two left, one centre, two right) under each reaction to
// hazards on both sides: R right, L left, G towards the goal, '-' no turn.
struct Row {
  std::string_view stripes;
  char rule_order;
  char toward_goal;
  char fewer_hazards;
};

constexpr Row kTable[] = {
    {"00000", '-', '-', '-'},
    // Hazard on the right only: turn left.
    {"00001", 'L', 'L', 'L'},
    {"00010", 'L', 'L', 'L'},
    {"00011", 'L', 'L', 'L'},
    // Centre: right if that is clear, otherwise left. 00110 depends on what clear means.
    {"00100", 'R', 'R', 'R'},
    {"00101", 'L', 'L', 'L'},
    {"00110", 'L', 'L', 'L'},
    {"00111", 'L', 'L', 'L'},
    // Hazard on the left, none on the right: turn right.
    {"01000", 'R', 'R', 'R'},
    {"01100", 'R', 'R', 'R'},
    {"10000", 'R', 'R', 'R'},
    {"10100", 'R', 'R', 'R'},
    {"11000", 'R', 'R', 'R'},
    {"11100", 'R', 'R', 'R'},
    // Both sides, with and without the centre.
    {"01001", 'R', 'G', 'R'},
    {"01010", 'R', 'G', 'R'},
    {"01011", 'R', 'G', 'L'},
    {"01101", 'R', 'G', 'R'},
    {"01110", 'R', 'G', 'R'},
    {"01111", 'R', 'G', 'L'},
    {"10001", 'R', 'G', 'R'},
    {"10010", 'R', 'G', 'R'},
    {"10011", 'R', 'G', 'L'},
    {"10101", 'R', 'G', 'R'},
    {"10110", 'R', 'G', 'R'},
    {"10111", 'R', 'G', 'L'},
    {"11001", 'R', 'G', 'R'},
    {"11010", 'R', 'G', 'R'},
    {"11011", 'R', 'G', 'R'},
    {"11101", 'R', 'G', 'R'},
    {"11110", 'R', 'G', 'R'},
    {"11111", 'R', 'G', 'R'},
};

char Expected(const Row& row, const PathfinderParams& params) {
  if (row.stripes == "00110" && params.right_is_clear == RightIsClear::kOutermostClear) return 'R';
  switch (params.both_sides) {
    case BothSidesReaction::kRuleOrder:
      return row.rule_order;
    case BothSidesReaction::kTowardGoal:
      return row.toward_goal;
    case BothSidesReaction::kFewerHazards:
      return row.fewer_hazards;
  }
  return '?';
}

int Direction(char turn, double goal_bearing_rad) {
  if (turn == 'G') return goal_bearing_rad > 0.0 ? 1 : -1;
  return turn == 'L' ? 1 : -1;
}

void CheckTable(const PathfinderParams& params) {
  for (const Row& row : kTable) {
    const char expected = Expected(row, params);
    if (expected == '-') continue;
    for (const double bearing_rad : {-3.0, -0.4, -0.01, 0.01, 0.4, 3.0}) {
      SCOPED_TRACE(std::string(row.stripes) + ", goal bearing " + std::to_string(bearing_rad));
      EXPECT_EQ(ChooseTurn(Report(row.stripes), bearing_rad, params),
                Direction(expected, bearing_rad));
    }
  }
}

TEST(Rules, TableNamesEveryPatternOnce) {
  std::array<int, 32> seen{};
  for (const Row& row : kTable) ++seen[std::stoul(std::string(row.stripes), nullptr, 2)];
  for (const int count : seen) EXPECT_EQ(count, 1);
}

TEST(Rules, TurnFollowsTableForEveryChoice) {
  for (const auto turn_direction : {TurnDirection::kLatched, TurnDirection::kEachScan}) {
    for (const auto both_sides : {BothSidesReaction::kRuleOrder, BothSidesReaction::kTowardGoal,
                                  BothSidesReaction::kFewerHazards}) {
      for (const auto right_is_clear :
           {RightIsClear::kNoRightHazard, RightIsClear::kOutermostClear}) {
        SCOPED_TRACE(testing::Message() << "both_sides " << static_cast<int>(both_sides)
                                        << ", right_is_clear " << static_cast<int>(right_is_clear));
        PathfinderParams params;
        params.turn_direction = turn_direction;
        params.both_sides = both_sides;
        params.right_is_clear = right_is_clear;
        CheckTable(params);
      }
    }
  }
}

TEST(Rules, DefaultsAreTheReadingOfThePaper) {
  const PathfinderParams params;
  EXPECT_EQ(params.turn_direction, TurnDirection::kLatched);
  EXPECT_EQ(params.both_sides, BothSidesReaction::kRuleOrder);
  EXPECT_EQ(params.right_is_clear, RightIsClear::kNoRightHazard);
  EXPECT_DOUBLE_EQ(params.scan_interval_m, 0.065);
  EXPECT_EQ(params.clear_distance_m, 0.0);
  EXPECT_EQ(params.time_out_s, 0.0);
  EXPECT_EQ(params.back_off_m, 0.0);
  EXPECT_EQ(params.threading_m, 0.0);
}

TEST(Rules, SidesAreThoseOfTheNamedStripes) {
  const PathfinderParams params;
  for (const Row& row : kTable) {
    SCOPED_TRACE(row.stripes);
    const HazardSides sides = ClassifySides(Report(row.stripes), params);
    EXPECT_EQ(sides.left, row.stripes.substr(0, 2) != "00");
    EXPECT_EQ(sides.centre, row.stripes[2] == '1');
    EXPECT_EQ(sides.right, row.stripes.substr(3, 2) != "00");
    EXPECT_EQ(sides.any(), row.stripes != "00000");
  }
}

TEST(Rules, WideCentreMovesStripesFromTheSides) {
  PathfinderParams params;
  params.left_stripes = {0};
  params.centre_stripes = {1, 2, 3};
  params.right_stripes = {4};
  const HazardSides inner_left = ClassifySides(Report("01000"), params);
  EXPECT_FALSE(inner_left.left);
  EXPECT_TRUE(inner_left.centre);
  EXPECT_FALSE(inner_left.right);
  // A centre hazard is passed on the right wherever it lies in the centre.
  EXPECT_EQ(ChooseTurn(Report("01000"), 0.4, params), -1);
  EXPECT_EQ(ChooseTurn(Report("00010"), 0.4, params), -1);
  EXPECT_EQ(ChooseTurn(Report("00011"), -0.4, params), 1);
  EXPECT_EQ(ChooseTurn(Report("00001"), -0.4, params), 1);
}

TEST(Rules, OutermostRightStripeIsTheOneFarthestRightInWhateverOrderListed) {
  PathfinderParams params;
  params.right_is_clear = RightIsClear::kOutermostClear;
  params.right_stripes = {4, 3};
  EXPECT_EQ(ChooseTurn(Report("00110"), 0.4, params), -1);
  EXPECT_EQ(ChooseTurn(Report("00101"), -0.4, params), 1);
}

TEST(Rules, CentreReachingTheRightEdgeLeavesTheRightClear) {
  PathfinderParams params;
  params.left_stripes = {0, 1};
  params.centre_stripes = {2, 3, 4};
  params.right_stripes = {};
  EXPECT_EQ(ChooseTurn(Report("00001"), 0.4, params), -1);
  EXPECT_EQ(ChooseTurn(Report("11111"), 0.4, params), -1);
  params.right_is_clear = RightIsClear::kOutermostClear;
  EXPECT_EQ(ChooseTurn(Report("00100"), 0.4, params), -1);
}

#ifdef ROCKYARD_CONTRACTS
TEST(Rules, TurnNeedsAHazard) {
  EXPECT_THROW(ChooseTurn(Report("00000"), 0.4, PathfinderParams{}), core::ContractViolation);
}
#endif

TEST(Curvature, GrowsInStepsWithTheBearing) {
  PathfinderParams params;
  params.heading_deadband_rad = 0.1;
  params.wide_arc_radius_m = 2.0;
  params.tight_arc_bearing_rad = 0.6;
  params.tight_arc_radius_m = 0.5;
  EXPECT_EQ(CurvatureToGoal(0.0, params), 0.0);
  EXPECT_EQ(CurvatureToGoal(0.09, params), 0.0);
  EXPECT_DOUBLE_EQ(CurvatureToGoal(0.11, params), 0.5);
  EXPECT_DOUBLE_EQ(CurvatureToGoal(0.59, params), 0.5);
  EXPECT_DOUBLE_EQ(CurvatureToGoal(0.61, params), 2.0);
  EXPECT_DOUBLE_EQ(CurvatureToGoal(3.1, params), 2.0);
}

TEST(Curvature, IsOddInTheBearing) {
  const PathfinderParams params;
  for (double bearing_rad = 0.0; bearing_rad < 3.1; bearing_rad += 0.037) {
    EXPECT_EQ(CurvatureToGoal(-bearing_rad, params), -CurvatureToGoal(bearing_rad, params));
  }
}

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
