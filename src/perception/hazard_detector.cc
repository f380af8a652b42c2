#include "perception/hazard_detector.h"

#include <algorithm>
#include <cmath>

namespace rockyard::perception {

namespace {

using messages::ElevationPoint;
using messages::ElevationScan;

struct Located {
  double elevation_m = 0.0;
  std::size_t stripe = 0;
};

using StripeFlags = messages::PerStripe<bool>;

// Charges the point farther from the datum plane, both on a tie: flat ground is taken to lie at
// elevation 0.
void ChargeFarther(const Located& a, const Located& b, StripeFlags& flags) {
  const double distance_a = std::abs(a.elevation_m);
  const double distance_b = std::abs(b.elevation_m);
  if (distance_a >= distance_b) flags[a.stripe] = true;
  if (distance_b >= distance_a) flags[b.stripe] = true;
}

// Charges a difference of neighbours: the paper says that there is a hazard, not where.
void ChargeNeighbours(const Located& a, const Located& b, NeighbourBlame blame,
                      StripeFlags& flags) {
  switch (blame) {
    case NeighbourBlame::kFartherFromDatum:
      ChargeFarther(a, b, flags);
      return;
    case NeighbourBlame::kHigher:
      flags[a.elevation_m > b.elevation_m ? a.stripe : b.stripe] = true;
      return;
    case NeighbourBlame::kBoth:
      flags[a.stripe] = true;
      flags[b.stripe] = true;
      return;
  }
}

// Charges the range of the whole array.
void ChargeRange(const Located& low, const Located& high, RangeBlame blame, StripeFlags& flags) {
  switch (blame) {
    case RangeBlame::kFartherFromDatum:
      ChargeFarther(low, high, flags);
      return;
    case RangeBlame::kExtremes:
      flags[low.stripe] = true;
      flags[high.stripe] = true;
      return;
    case RangeBlame::kAllStripes:
      flags.fill(true);
      return;
  }
}

// Criterion 1 (Matthies 1995, section 6): row 0 is the nearest.
void FindMissing(const ElevationScan& scan, StripeFlags& flags) {
  for (std::size_t stripe = 0; stripe < flags.size(); ++stripe) {
    flags[stripe] = !scan.points[0][stripe].detected || !scan.points[1][stripe].detected;
  }
}

// Criterion 2: |difference| above the threshold. A difference that equals the threshold is no
// hazard.
void CompareNeighbours(const Located& a, const Located& b, const HazardParams& params,
                       StripeFlags& flags) {
  if (std::abs(a.elevation_m - b.elevation_m) <= params.neighbour_threshold_m) return;
  ChargeNeighbours(a, b, params.neighbour_blame, flags);
}

// The indices up to `reach` from an index: the first, and the one after the last.
struct Reach {
  std::size_t first;
  std::size_t end;
};
Reach Around(std::size_t at, std::size_t reach, std::size_t size) {
  return {at > reach ? at - reach : 0, std::min(at + reach + 1, size)};
}

// Criterion 2 over all pairs up to `reach` rows and stripes apart, diagonals included.
void FindNeighbours(const ElevationScan& scan, const HazardParams& params, StripeFlags& flags) {
  const auto reach = static_cast<std::size_t>(params.neighbour_reach);
  const auto [rows, stripes] = scan.points.size();
  for (std::size_t row = 0; row < rows; ++row) {
    // Down to later rows only, so that each pair is met once.
    const std::size_t end_row = Around(row, reach, rows).end;
    for (std::size_t stripe = 0; stripe < stripes; ++stripe) {
      const ElevationPoint& a = scan.points[row][stripe];
      if (!a.detected) continue;
      const Reach aside = Around(stripe, reach, stripes);
      for (std::size_t other_row = row; other_row < end_row; ++other_row) {
        // Along its own row only to the right, so that each pair is met once.
        const std::size_t first = other_row == row ? stripe + 1 : aside.first;
        for (std::size_t other = first; other < aside.end; ++other) {
          const ElevationPoint& b = scan.points[other_row][other];
          if (!b.detected) continue;
          CompareNeighbours({a.elevation_m, stripe}, {b.elevation_m, other}, params, flags);
        }
      }
    }
  }
}

// Criterion 3: highest less lowest elevation of the whole array.
void FindRange(const ElevationScan& scan, const HazardParams& params, StripeFlags& flags) {
  bool any = false;
  Located low;
  Located high;
  const auto [rows, stripes] = scan.points.size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t stripe = 0; stripe < stripes; ++stripe) {
      const ElevationPoint& at = scan.points[row][stripe];
      if (!at.detected) continue;
      // Of equal extremes the first met must count: nearest row, leftmost stripe. Records depend
      // on it.
      const Located point{at.elevation_m, stripe};
      if (!any || point.elevation_m < low.elevation_m) low = point;
      if (!any || point.elevation_m > high.elevation_m) high = point;
      any = true;
    }
  }
  if (!any || high.elevation_m - low.elevation_m <= params.range_threshold_m) return;
  ChargeRange(low, high, params.range_blame, flags);
}

}  // namespace

HazardFindings AssessHazards(const ElevationScan& scan, const HazardParams& params) {
  HazardFindings findings(scan.points.stripes());
  // The three criteria do not see one another: what each charges stays apart.
  FindMissing(scan, findings.missing);
  FindNeighbours(scan, params, findings.neighbour);
  FindRange(scan, params, findings.range);
  return findings;
}

messages::HazardReport ReportHazards(const ElevationScan& scan, const HazardParams& params) {
  const HazardFindings findings = AssessHazards(scan, params);
  messages::HazardReport report{scan.number, messages::PerStripe<bool>(scan.points.stripes())};
  for (std::size_t stripe = 0; stripe < report.stripe_hazard.size(); ++stripe) {
    report.stripe_hazard[stripe] = findings.Charges(stripe);
  }
  return report;
}

// All elevations are compared, not only those that are charged. A point that is missing in one of
// the scans disagrees.
bool ScansAgree(const ElevationScan& a, const ElevationScan& b, double agree_m) {
  const auto agree = [agree_m](const ElevationPoint& p, const ElevationPoint& q) {
    if (p.detected != q.detected) return false;
    return !p.detected || std::abs(p.elevation_m - q.elevation_m) <= agree_m;
  };
  const auto before = a.points.points();
  const auto now = b.points.points();
  return std::equal(before.begin(), before.end(), now.begin(), now.end(), agree);
}

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
  // The scans disagree, and no further scan is taken.
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
