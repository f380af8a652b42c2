// The three criteria of Matthies 1995, section 6, which stripes they charge, and the two-scan rule
// as a truth table over its readings.
#include "perception/hazard_detector.h"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>

#include "core/archive.h"
#include "core/error.h"
#include "messages/estimates.h"

namespace rockyard::perception {
namespace {

using messages::ElevationScan;

// Elevation scans made by hand.

using Stripes = messages::PerStripe<bool>;

Stripes Only(std::initializer_list<std::size_t> stripes) {
  Stripes flags{};
  for (const std::size_t stripe : stripes) flags[stripe] = true;
  return flags;
}

// Every point found; each row at one elevation, nearest row first.
messages::ElevationScan ScanOfRows(const std::array<double, messages::kStripeRows>& rows) {
  messages::ElevationScan scan;
  for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
    for (messages::ElevationPoint& point : scan.points[row]) {
      point = {.detected = true, .elevation_m = rows[row]};
    }
  }
  return scan;
}

messages::ElevationScan FlatScan() { return ScanOfRows({0.0, 0.0, 0.0, 0.0}); }

// Flat but for one point of row 2.
messages::ElevationScan RockScan(std::size_t stripe, double elevation_m) {
  messages::ElevationScan scan = FlatScan();
  scan.points[2][stripe].elevation_m = elevation_m;
  return scan;
}

// The three criteria of Matthies 1995, section 6, and which stripes they charge.

constexpr Stripes kNone{};
constexpr Stripes kAll{true, true, true, true, true};

TEST(HazardCriteriaTest, FlatGroundIsClear) {
  const auto findings = AssessHazards(FlatScan(), {});
  EXPECT_EQ(findings.missing, kNone);
  EXPECT_EQ(findings.neighbour, kNone);
  EXPECT_EQ(findings.range, kNone);
  EXPECT_FALSE(ReportHazards(FlatScan(), {}).any());
}

TEST(HazardCriteriaTest, EitherOfTheNearestTwoPointsMissing) {
  for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
    auto scan = FlatScan();
    scan.points[row][3].detected = false;
    EXPECT_EQ(AssessHazards(scan, {}).missing, row < 2 ? Only({3}) : kNone) << row;
  }
}

TEST(HazardCriteriaTest, AllPointsMissingChargesEveryStripeOnce) {
  const auto findings = AssessHazards({}, {});
  EXPECT_EQ(findings.missing, kAll);
  EXPECT_EQ(findings.neighbour, kNone);
  EXPECT_EQ(findings.range, kNone);
}

TEST(HazardCriteriaTest, NeighbourDifferenceMustExceedTheThreshold) {
  auto scan = FlatScan();
  scan.points[2][2].elevation_m = 0.05;
  EXPECT_EQ(AssessHazards(scan, {}).neighbour, kNone) << "equal to the threshold";
  scan.points[2][2].elevation_m = 0.0501;
  EXPECT_EQ(AssessHazards(scan, {}).neighbour, Only({2}));
  scan.points[2][2].elevation_m = -0.0501;
  EXPECT_EQ(AssessHazards(scan, {}).neighbour, Only({2}));
  const HazardParams high{.neighbour_threshold_m = 0.13};
  EXPECT_EQ(AssessHazards(scan, high).neighbour, kNone);
}

// Every pair of points: charged if and only if they are 8-connected.
TEST(HazardCriteriaTest, NeighboursAreEightConnected) {
  const HazardParams params{.range_threshold_m = 1.0, .neighbour_blame = NeighbourBlame::kBoth};
  for (int a = 0; a < 20; ++a) {
    for (int b = 0; b < 20; ++b) {
      if (a == b) continue;
      auto scan = messages::ElevationScan{};  // two points alone
      const auto at = [&](int i) -> messages::ElevationPoint& {
        return scan.points[static_cast<std::size_t>(i / 5)][static_cast<std::size_t>(i % 5)];
      };
      at(a) = {.detected = true, .elevation_m = 0.0};
      at(b) = {.detected = true, .elevation_m = 0.06};
      const bool connected = std::abs(a / 5 - b / 5) <= 1 && std::abs(a % 5 - b % 5) <= 1;
      const auto expected =
          connected ? Only({static_cast<std::size_t>(a % 5), static_cast<std::size_t>(b % 5)})
                    : kNone;
      EXPECT_EQ(AssessHazards(scan, params).neighbour, expected) << a << " " << b;
    }
  }
}

// The same on a denser array, whose points at the spacing of the published one are two apart.
TEST(HazardCriteriaTest, NeighboursReachAsFarAsTheyAreTold) {
  constexpr messages::StripeArraySize kDense{7, 9};
  const HazardParams params{
      .range_threshold_m = 1.0, .neighbour_reach = 2, .neighbour_blame = NeighbourBlame::kBoth};
  constexpr int kPoints = 7 * 9;
  for (int a = 0; a < kPoints; ++a) {
    for (int b = a + 1; b < kPoints; ++b) {
      messages::ElevationScan scan{0, messages::StripeArray<messages::ElevationPoint>(kDense)};
      scan.points.points()[static_cast<std::size_t>(a)] = {.detected = true, .elevation_m = 0.0};
      scan.points.points()[static_cast<std::size_t>(b)] = {.detected = true, .elevation_m = 0.06};
      const bool connected = std::abs(a / 9 - b / 9) <= 2 && std::abs(a % 9 - b % 9) <= 2;
      messages::PerStripe<bool> expected(kDense.stripes);
      if (connected) {
        expected[static_cast<std::size_t>(a % 9)] = true;
        expected[static_cast<std::size_t>(b % 9)] = true;
      }
      EXPECT_EQ(AssessHazards(scan, params).neighbour, expected) << a << " " << b;
    }
  }
}

TEST(HazardCriteriaTest, RangeOfTheWholeArray) {
  // A slope too gentle for neighbours: 3.5 cm per row, 10.5 cm in all.
  HazardParams params{.range_threshold_m = 0.10};
  const auto scan = ScanOfRows({0.0, 0.035, 0.07, 0.105});
  EXPECT_EQ(AssessHazards(scan, params).neighbour, kNone);
  EXPECT_TRUE(ReportHazards(scan, params).any());
  params.range_threshold_m = 0.105;
  EXPECT_FALSE(ReportHazards(scan, params).any()) << "equal to the threshold";
}

TEST(HazardCriteriaTest, MissingPointsTakeNoPartInDifferences) {
  auto scan = FlatScan();
  scan.points[3][2] = {.detected = false, .elevation_m = 1.0};
  EXPECT_FALSE(ReportHazards(scan, {}).any());
}

TEST(HazardCriteriaTest, BlameOfNeighbours) {
  auto rock = FlatScan();
  rock.points[2][3].elevation_m = 0.08;
  auto pit = FlatScan();
  pit.points[2][3].elevation_m = -0.08;
  const auto charged = [](const messages::ElevationScan& scan, NeighbourBlame blame) {
    const HazardParams params{.neighbour_blame = blame};
    return AssessHazards(scan, params).neighbour;
  };
  EXPECT_EQ(charged(rock, NeighbourBlame::kFartherFromDatum), Only({3}));
  EXPECT_EQ(charged(pit, NeighbourBlame::kFartherFromDatum), Only({3}));
  EXPECT_EQ(charged(rock, NeighbourBlame::kHigher), Only({3}));
  EXPECT_EQ(charged(pit, NeighbourBlame::kHigher), Only({2, 3, 4}));
  EXPECT_EQ(charged(rock, NeighbourBlame::kBoth), Only({2, 3, 4}));
  // Equally far from the datum plane: both.
  auto tie = FlatScan();
  tie.points[3][0].elevation_m = 0.03;
  tie.points[3][1].elevation_m = -0.03;
  EXPECT_EQ(charged(tie, NeighbourBlame::kFartherFromDatum), Only({0, 1}));
}

TEST(HazardCriteriaTest, BlameOfTheRange) {
  auto scan = FlatScan();
  scan.points[3][0].elevation_m = 0.08;
  scan.points[0][4].elevation_m = -0.04;
  const auto charged = [&](RangeBlame blame) {
    const HazardParams params{
        .neighbour_threshold_m = 1.0, .range_threshold_m = 0.10, .range_blame = blame};
    return AssessHazards(scan, params).range;
  };
  EXPECT_EQ(charged(RangeBlame::kFartherFromDatum), Only({0}));
  EXPECT_EQ(charged(RangeBlame::kExtremes), Only({0, 4}));
  EXPECT_EQ(charged(RangeBlame::kAllStripes), kAll);
}

TEST(ScansAgreeTest, EveryPointWithinTheTolerance) {
  const auto flat = FlatScan();
  for (std::size_t row = 0; row < messages::kStripeRows; ++row) {
    for (std::size_t stripe = 0; stripe < messages::kStripes; ++stripe) {
      auto other = FlatScan();
      other.points[row][stripe].elevation_m = 0.02;
      EXPECT_TRUE(ScansAgree(flat, other, 0.02));
      other.points[row][stripe].elevation_m = -0.0201;
      EXPECT_FALSE(ScansAgree(flat, other, 0.02));
      EXPECT_FALSE(ScansAgree(other, flat, 0.02));
    }
  }
}

TEST(ScansAgreeTest, MissingAgreesOnlyWithMissing) {
  auto gap = FlatScan();
  gap.points[3][1].detected = false;
  EXPECT_FALSE(ScansAgree(FlatScan(), gap, 1e9));
  EXPECT_FALSE(ScansAgree(gap, FlatScan(), 1e9));
  EXPECT_TRUE(ScansAgree(gap, gap, 0.0));
}

// The two-scan rule of Matthies 1995, section 6, as a truth table over its readings.

// That a verdict is the last word, and which stripes it calls hazards.
void ExpectDecided(const HazardDetector::Verdict& verdict, const Stripes& stripes) {
  EXPECT_FALSE(verdict.scan_again);
  EXPECT_EQ(verdict.report.stripe_hazard, stripes);
  EXPECT_EQ(verdict.report.any(), !(stripes == Only({})));
}

ElevationScan Numbered(ElevationScan scan, std::int64_t number) {
  scan.number = number;
  return scan;
}

const ElevationScan kFlat = FlatScan();
const ElevationScan kLeft = RockScan(0, 0.10);
const ElevationScan kRight = RockScan(4, 0.10);

HazardParams With(ScanAgreement agreement, Disagreement on_disagreement) {
  return {.agreement = agreement, .on_disagreement = on_disagreement};
}

TEST(HazardDetectorTest, BlindRoverSeesNothing) {
  HazardDetector detector({.enabled = false});
  ExpectDecided(detector.Process(ElevationScan{}), Only({}));
}

TEST(HazardDetectorTest, SingleScanIsBelieved) {
  HazardDetector detector(With(ScanAgreement::kSingleScan, Disagreement::kScanAgain));
  const auto verdict = detector.Process(Numbered(kLeft, 7));
  ExpectDecided(verdict, Only({0}));
  EXPECT_EQ(verdict.report.scan_number, 7);
}

TEST(HazardDetectorTest, ClearScanNeedsNoSecond) {
  ExpectDecided(HazardDetector({}).Process(kFlat), Only({}));
}

TEST(HazardDetectorTest, DetectionAsksForASecondScanAndIsBelievedIfItAgrees) {
  HazardDetector detector({});
  const auto first = detector.Process(kLeft);
  EXPECT_TRUE(first.scan_again);
  EXPECT_FALSE(first.report.any());
  const auto second = detector.Process(Numbered(RockScan(0, 0.11), 1));
  ExpectDecided(second, Only({0}));
  EXPECT_EQ(second.report.scan_number, 1);
}

TEST(HazardDetectorTest, SecondScanWithoutAHazardIsClear) {
  for (const auto rule : {Disagreement::kScanAgain, Disagreement::kTrustLast,
                          Disagreement::kTreatAsHazard, Disagreement::kTreatAsClear}) {
    HazardDetector detector(With(ScanAgreement::kRescanSamePose, rule));
    EXPECT_TRUE(detector.Process(kLeft).scan_again);
    ExpectDecided(detector.Process(kFlat), Only({}));
  }
}

TEST(HazardDetectorTest, DisagreementAtOnePose) {
  const auto second = [](Disagreement rule) {
    HazardDetector detector(With(ScanAgreement::kRescanSamePose, rule));
    detector.Process(kLeft);
    return detector.Process(kRight);
  };
  EXPECT_TRUE(second(Disagreement::kScanAgain).scan_again);
  ExpectDecided(second(Disagreement::kTrustLast), Only({4}));
  ExpectDecided(second(Disagreement::kTreatAsHazard), Only({0, 4}));
  ExpectDecided(second(Disagreement::kTreatAsClear), Only({}));
}

TEST(HazardDetectorTest, ScanningAgainComparesTheNewestTwo) {
  HazardDetector detector({});
  EXPECT_TRUE(detector.Process(kLeft).scan_again);
  EXPECT_TRUE(detector.Process(kRight).scan_again);
  ExpectDecided(detector.Process(kRight), Only({4}));
}

TEST(HazardDetectorTest, ScanningAgainEnds) {
  const auto after_three = [](Disagreement on_exhausted) {
    HazardDetector detector({.max_scans = 3, .on_exhausted = on_exhausted});
    EXPECT_TRUE(detector.Process(kLeft).scan_again);
    EXPECT_TRUE(detector.Process(kRight).scan_again);
    return detector.Process(kLeft);
  };
  ExpectDecided(after_three(Disagreement::kTrustLast), Only({0}));
  ExpectDecided(after_three(Disagreement::kTreatAsHazard), Only({0, 4}));
  ExpectDecided(after_three(Disagreement::kTreatAsClear), Only({}));
}

TEST(HazardDetectorTest, ADecisionAndANewPoseBothStartAfresh) {
  HazardDetector detector({});
  detector.Process(kLeft);
  EXPECT_FALSE(detector.Process(kLeft).scan_again);
  EXPECT_TRUE(detector.Process(kLeft).scan_again) << "decided before";
  detector.Reset();
  EXPECT_TRUE(detector.Process(kLeft).scan_again) << "the earlier scan is from another pose";
}

TEST(HazardDetectorTest, ConsecutiveScansOfTheMovingRover) {
  for (const auto rule : {Disagreement::kScanAgain, Disagreement::kTrustLast,
                          Disagreement::kTreatAsHazard, Disagreement::kTreatAsClear}) {
    HazardDetector detector(With(ScanAgreement::kConsecutiveMoving, rule));
    ExpectDecided(detector.Process(kLeft), Only({}));  // nothing to agree with
    detector.Reset();
    ExpectDecided(detector.Process(kLeft), Only({0}));  // agrees with the scan before
    detector.Reset();
    const auto expected = rule == Disagreement::kTrustLast       ? Only({4})
                          : rule == Disagreement::kTreatAsHazard ? Only({0, 4})
                                                                 : Only({});
    ExpectDecided(detector.Process(kRight), expected);
    detector.Reset();
    EXPECT_FALSE(detector.Process(kFlat).report.any());
  }
}

TEST(HazardParamsTest, ScanAgainCannotEndTheScanning) {
  HazardParams params;
  core::JsonValue json = core::WriteParams(params);
  json.Set("on_exhausted", core::JsonValue("scan_again"));
  EXPECT_THROW(core::ReadParams(json, params), core::UserError);
}

}  // namespace
}  // namespace rockyard::perception
