#include "perception/hazard_detector.h"

#include "perception/hazard_criteria.h"

namespace rockyard::perception {
namespace {

messages::HazardReport Clear(const messages::ElevationScan& scan) {
  return {scan.number, messages::PerStripe<bool>(scan.points.stripes())};
}

// A stripe is a hazard where either scan says so.
messages::HazardReport Union(const messages::HazardReport& before,
                             const messages::HazardReport& now) {
  messages::HazardReport both = now;
  for (std::size_t stripe = 0; stripe < both.stripe_hazard.size(); ++stripe) {
    both.stripe_hazard[stripe] = now.stripe_hazard[stripe] || before.stripe_hazard[stripe];
  }
  return both;
}

}  // namespace

messages::HazardReport HazardDetector::Resolve(Disagreement rule, const Seen& before,
                                               const Seen& now) {
  // What is believed when two scans disagree and no further one is taken.
  switch (rule) {
    case Disagreement::kTrustLast:
      return now.report;
    case Disagreement::kTreatAsHazard:
      return Union(before.report, now.report);
    case Disagreement::kScanAgain:
    case Disagreement::kTreatAsClear:
      break;
  }
  return Clear(now.scan);
}

// Rescans at rest: undecided until two scans in a row agree, one is clear, or max_scans are taken.
HazardDetector::Verdict HazardDetector::CompareAtPose(const Seen& now) {
  ++scans_here_;
  // A scan without a detection is clear at once, also as the second: the hazard was not seen twice.
  if (!now.report.any()) return {.report = now.report};
  if (!previous_) {
    previous_ = now;
    return {.scan_again = true, .report = Clear(now.scan)};
  }
  // The newest scan is compared with the one before, not with the first.
  const Seen before = *previous_;
  previous_ = now;
  if (ScansAgree(before.scan, now.scan, params_.agree_m)) return {.report = now.report};
  if (params_.on_disagreement != Disagreement::kScanAgain) {
    return {.report = Resolve(params_.on_disagreement, before, now)};
  }
  if (scans_here_ < params_.max_scans) return {.scan_again = true, .report = Clear(now.scan)};
  return {.report = Resolve(params_.on_exhausted, before, now)};
}

// Scans of a moving rover: each is held against the one before.
HazardDetector::Verdict HazardDetector::CompareOnTheWay(const Seen& now) {
  const std::optional<Seen> before = previous_;
  previous_ = now;
  if (!now.report.any()) return {.report = now.report};
  // The first scan of a drive has nothing to agree with.
  if (!before) return {.report = Clear(now.scan)};
  if (ScansAgree(before->scan, now.scan, params_.agree_m)) return {.report = now.report};
  return {.report = Resolve(params_.on_disagreement, *before, now)};
}

HazardDetector::Verdict HazardDetector::Process(const messages::ElevationScan& scan) {
  if (!params_.enabled) return {.report = Clear(scan)};
  const Seen now{scan, ReportHazards(scan, params_)};
  switch (params_.agreement) {
    case ScanAgreement::kSingleScan:
      return {.report = now.report};
    case ScanAgreement::kRescanSamePose: {
      const Verdict verdict = CompareAtPose(now);
      // Decided: the next scan is the first of its pose.
      if (!verdict.scan_again) Reset();
      return verdict;
    }
    case ScanAgreement::kConsecutiveMoving:
      break;
  }
  return CompareOnTheWay(now);
}

void HazardDetector::Reset() {
  if (params_.agreement == ScanAgreement::kConsecutiveMoving) return;
  previous_.reset();
  scans_here_ = 0;
}

}  // namespace rockyard::perception
