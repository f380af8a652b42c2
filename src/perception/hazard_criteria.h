// The three hazard criteria of Matthies 1995, section 6, on one scan, and the agreement of two
// scans.
#pragma once

#include "messages/estimates.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// Stripes charged by each criterion.
struct HazardFindings {
  explicit HazardFindings(std::size_t stripes)
      : missing(stripes), neighbour(stripes), range(stripes) {}

  messages::PerStripe<bool> missing;    // either of the nearest two points missing
  messages::PerStripe<bool> neighbour;  // difference of neighbours above the threshold
  messages::PerStripe<bool> range;      // highest - lowest of the array above another

  bool Charges(std::size_t stripe) const {
    return missing[stripe] || neighbour[stripe] || range[stripe];
  }
};

// Missing points take no part in the second and third criterion.
HazardFindings AssessHazards(const messages::ElevationScan& scan, const HazardParams& params);

// The same as one flag per stripe.
messages::HazardReport ReportHazards(const messages::ElevationScan& scan,
                                     const HazardParams& params);

// True if each of the points is missing in both scans, or found in both at elevations that
// differ by no more than agree_m.
bool ScansAgree(const messages::ElevationScan& a, const messages::ElevationScan& b, double agree_m);

}  // namespace rockyard::perception
