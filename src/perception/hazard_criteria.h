// The three hazard criteria of Matthies 1995, section 6, on one scan, and the agreement of two
// scans.
#pragma once

#include <array>

#include "messages/estimates.h"
#include "perception/hazard_params.h"

namespace rockyard::perception {

// Stripes charged by each criterion.
struct HazardFindings {
  std::array<bool, messages::kStripes> missing{};    // either of the nearest two points missing
  std::array<bool, messages::kStripes> neighbour{};  // 8-connected difference above the threshold
  std::array<bool, messages::kStripes> range{};      // highest - lowest of the array above another

  bool Charges(std::size_t stripe) const {
    return missing[stripe] || neighbour[stripe] || range[stripe];
  }
};

// Missing points take no part in the second and third criterion.
HazardFindings AssessHazards(const messages::ElevationScan& scan, const HazardParams& params);

// The same as one flag per stripe.
messages::HazardReport ReportHazards(const messages::ElevationScan& scan,
                                     const HazardParams& params);

// True if each of the 20 points is missing in both scans, or found in both at elevations that
// differ by no more than agree_m.
bool ScansAgree(const messages::ElevationScan& a, const messages::ElevationScan& b, double agree_m);

}  // namespace rockyard::perception
