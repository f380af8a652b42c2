// From elevation scans to believed hazards: the criteria and the two-scan rule of Matthies 1995,
// section 6.
//
// The paper requires that detected hazards be seen consistently in two consecutive scans, which it
// implements by comparing all elevations of the two. It does not say whether the rover waits for
// the second scan or takes it after the next stretch of motion, nor what happens on disagreement;
// both are parameters. A scan without a detection is clear at once, also as second scan: then the
// hazard was not seen twice.
#pragma once

#include <optional>

#include "messages/estimates.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// The state of the two-scan rule.
class HazardDetector {
 public:
  struct Verdict {
    bool scan_again = false;        // undecided: take another scan before moving
    messages::HazardReport report;  // what is believed, where decided; stripes clear otherwise
  };

  explicit HazardDetector(const HazardParams& params) : params_(params) {}

  // Takes the next scan, in order of time. Decides after at most params.max_scans scans at one
  // pose.
  Verdict Process(const messages::ElevationScan& scan);

  // Is called when the rover is about to scan from a new pose: a scan from the old one takes no
  // part in kRescanSamePose any more. kConsecutiveMoving keeps it, since there the pose may differ.
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
