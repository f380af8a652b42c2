// The three hazard criteria of Matthies 1995, section 6, on one scan, and the agreement of two
// scans.
#pragma once

#include "messages/estimates.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// The stripes that each criterion charges.
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

// Applies the three criteria. Missing points take no part in the second and third.
HazardFindings AssessHazards(const messages::ElevationScan& scan, const HazardParams& params);

// Returns the same as one flag per stripe.
messages::HazardReport ReportHazards(const messages::ElevationScan& scan,
                                     const HazardParams& params);

// Returns whether each of the points is missing in both scans, or found in both at elevations that
// differ by no more than agree_m.
bool ScansAgree(const messages::ElevationScan& a, const messages::ElevationScan& b, double agree_m);

}  // namespace rockyard::perception
