// The two-scan rule of Matthies 1995, section 6, as a truth table over its readings.
#include "perception/hazard_detector.h"

#include <gtest/gtest.h>

#include "core/archive.h"
#include "core/error.h"
#include "perception/scans.h"

namespace rockyard::perception {
namespace {

using messages::ElevationScan;

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
