// The three hazard criteria of Matthies 1995, section 6, on one scan, and the two-scan rule: from
// elevation scans to believed hazards. Drives, studies of the sensor and replays must all judge
// scans here, so that a study measures what drives do, and a page shows what the rover found.
#pragma once

#include <optional>

#include "messages/estimates.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// The stripes that each criterion charges.
struct HazardFindings {
  explicit HazardFindings(std::size_t stripes)
      : missing(stripes), neighbour(stripes), range(stripes) {}

  messages::PerStripe<bool> missing;    // either of the nearest two points missing
  messages::PerStripe<bool> neighbour;  // difference of neighbours above the threshold
  messages::PerStripe<bool> range;      // highest - lowest of the array above its threshold

  bool Charges(std::size_t stripe) const {
    return missing[stripe] || neighbour[stripe] || range[stripe];
  }
};

// Applies the three criteria. Missing points take no part in the second and third.
HazardFindings AssessHazards(const messages::ElevationScan& scan, const HazardParams& params);

// Applies the three criteria and returns one flag per stripe: whether any of them charges it.
messages::HazardReport ReportHazards(const messages::ElevationScan& scan,
                                     const HazardParams& params);

// Returns whether each point of the array is missing in both scans, or found in both at elevations
// that differ by no more than agree_m.
bool ScansAgree(const messages::ElevationScan& a, const messages::ElevationScan& b, double agree_m);

// The two-scan rule. The paper requires that detected hazards be seen consistently in two
// consecutive scans, and compares all elevations of the two. It does not say whether the rover
// waits for the second scan or takes it after the next stretch of motion, nor what happens on
// disagreement; both are parameters. A scan without a detection is clear at once, also as second
// scan: then the hazard was not seen twice.
class HazardDetector {
 public:
  struct Verdict {
    bool scan_again = false;        // undecided: take another scan before moving
    messages::HazardReport report;  // what is believed; while undecided, all stripes clear
  };

  explicit HazardDetector(const HazardParams& params) : params_(params) {}

  // Takes the next scan, in order of time. Decides after at most params.max_scans scans at one
  // pose.
  Verdict Process(const messages::ElevationScan& scan);

  // Is called when the rover is about to scan from a new pose. With kRescanSamePose, scans from the
  // old pose are forgotten; kConsecutiveMoving keeps the last scan, since there the pose may
  // differ.
  void Reset();

 private:
  struct Seen {
    messages::ElevationScan scan;
    messages::HazardReport report;
  };

  Verdict CompareAtPose(const Seen& now);
  Verdict CompareOnTheWay(const Seen& now);
  static messages::HazardReport Resolve(Disagreement rule, const Seen& before, const Seen& now);

  HazardParams params_;
  std::optional<Seen> previous_;
  int scans_here_ = 0;
};

}  // namespace rockyard::perception
