// The two-scan rule of Matthies 1995, section 6, as a truth table over its readings.
#include "perception/hazard_detector.h"

#include <gtest/gtest.h>

#include "core/archive.h"
#include "core/error.h"
#include "perception/scans.h"

namespace rockyard::perception {
namespace {

using messages::ElevationScan;
using Stripes = messages::PerStripe<bool>;

Stripes Only(std::initializer_list<std::size_t> stripes) {
  Stripes flags{};
  for (const std::size_t stripe : stripes) flags[stripe] = true;
  return flags;
}

ElevationScan Numbered(ElevationScan scan, std::int64_t number) {
  scan.number = number;
  return scan;
}

const ElevationScan kFlat = FlatScan();
const ElevationScan kLeft = RockScan(0, 0.10);
const ElevationScan kRight = RockScan(4, 0.10);

HazardParams With(ScanAgreement agreement, Disagreement on_disagreement) {
  HazardParams params;
  params.agreement = agreement;
  params.on_disagreement = on_disagreement;
  return params;
}

TEST(HazardDetectorTest, BlindRoverSeesNothing) {
  HazardParams params;
  params.enabled = false;
  HazardDetector detector(params);
  const auto verdict = detector.Process(ElevationScan{});
  EXPECT_FALSE(verdict.scan_again);
  EXPECT_FALSE(verdict.report.any());
}

TEST(HazardDetectorTest, SingleScanIsBelieved) {
  HazardDetector detector(With(ScanAgreement::kSingleScan, Disagreement::kScanAgain));
  const auto verdict = detector.Process(Numbered(kLeft, 7));
  EXPECT_FALSE(verdict.scan_again);
  EXPECT_EQ(verdict.report.stripe_hazard, Only({0}));
  EXPECT_EQ(verdict.report.scan_number, 7);
}

TEST(HazardDetectorTest, ClearScanNeedsNoSecond) {
  HazardDetector detector({});
  const auto verdict = detector.Process(kFlat);
  EXPECT_FALSE(verdict.scan_again);
  EXPECT_FALSE(verdict.report.any());
}

TEST(HazardDetectorTest, DetectionAsksForASecondScanAndIsBelievedIfItAgrees) {
  HazardDetector detector({});
  const auto first = detector.Process(kLeft);
  EXPECT_TRUE(first.scan_again);
  EXPECT_FALSE(first.report.any());
  const auto second = detector.Process(Numbered(RockScan(0, 0.11), 1));
  EXPECT_FALSE(second.scan_again);
  EXPECT_EQ(second.report.stripe_hazard, Only({0}));
  EXPECT_EQ(second.report.scan_number, 1);
}

TEST(HazardDetectorTest, SecondScanWithoutAHazardIsClear) {
  for (const auto rule : {Disagreement::kScanAgain, Disagreement::kTrustLast,
                          Disagreement::kTreatAsHazard, Disagreement::kTreatAsClear}) {
    HazardDetector detector(With(ScanAgreement::kRescanSamePose, rule));
    EXPECT_TRUE(detector.Process(kLeft).scan_again);
    const auto verdict = detector.Process(kFlat);
    EXPECT_FALSE(verdict.scan_again);
    EXPECT_FALSE(verdict.report.any());
  }
}

TEST(HazardDetectorTest, DisagreementAtOnePose) {
  const auto second = [](Disagreement rule) {
    HazardDetector detector(With(ScanAgreement::kRescanSamePose, rule));
    detector.Process(kLeft);
    return detector.Process(kRight);
  };
  EXPECT_TRUE(second(Disagreement::kScanAgain).scan_again);
  EXPECT_EQ(second(Disagreement::kTrustLast).report.stripe_hazard, Only({4}));
  EXPECT_EQ(second(Disagreement::kTreatAsHazard).report.stripe_hazard, Only({0, 4}));
  EXPECT_EQ(second(Disagreement::kTreatAsClear).report.stripe_hazard, Only({}));
  for (const auto rule :
       {Disagreement::kTrustLast, Disagreement::kTreatAsHazard, Disagreement::kTreatAsClear}) {
    EXPECT_FALSE(second(rule).scan_again);
  }
}

TEST(HazardDetectorTest, ScanningAgainComparesTheNewestTwo) {
  HazardDetector detector({});
  EXPECT_TRUE(detector.Process(kLeft).scan_again);
  EXPECT_TRUE(detector.Process(kRight).scan_again);
  const auto verdict = detector.Process(kRight);
  EXPECT_FALSE(verdict.scan_again);
  EXPECT_EQ(verdict.report.stripe_hazard, Only({4}));
}

TEST(HazardDetectorTest, ScanningAgainEnds) {
  const auto after_three = [](Disagreement on_exhausted) {
    HazardParams params;
    params.max_scans = 3;
    params.on_exhausted = on_exhausted;
    HazardDetector detector(params);
    EXPECT_TRUE(detector.Process(kLeft).scan_again);
    EXPECT_TRUE(detector.Process(kRight).scan_again);
    const auto verdict = detector.Process(kLeft);
    EXPECT_FALSE(verdict.scan_again);
    return verdict.report.stripe_hazard;
  };
  EXPECT_EQ(after_three(Disagreement::kTrustLast), Only({0}));
  EXPECT_EQ(after_three(Disagreement::kTreatAsHazard), Only({0, 4}));
  EXPECT_EQ(after_three(Disagreement::kTreatAsClear), Only({}));
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
    auto verdict = detector.Process(kLeft);
    EXPECT_FALSE(verdict.scan_again);
    EXPECT_FALSE(verdict.report.any()) << "nothing to agree with";
    detector.Reset();
    verdict = detector.Process(kLeft);
    EXPECT_FALSE(verdict.scan_again);
    EXPECT_EQ(verdict.report.stripe_hazard, Only({0})) << "agrees with the scan before";
    detector.Reset();
    verdict = detector.Process(kRight);
    EXPECT_FALSE(verdict.scan_again);
    const auto expected = rule == Disagreement::kTrustLast       ? Only({4})
                          : rule == Disagreement::kTreatAsHazard ? Only({0, 4})
                                                                 : Only({});
    EXPECT_EQ(verdict.report.stripe_hazard, expected);
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
