// The elevation array of one scan, seen from above, and as text.
#pragma once

#include <string>

#include "report/scan_view.h"

namespace rockyard::report {

// SVG: the rover's outline and the rocks, light planes as lines, found points as circles coloured
// by their elevation (blue below, white at, red above the datum plane) with its value in mm,
// missing points as crosses where level ground would show them, and the stripes with a hazard in
// red. Forward is up.
std::string ScanSvg(const ScanView& scan);

// Elevations in mm, farthest row first, '-' where nothing was found, and the hazards of each
// stripe, as the rover sees them: left to right.
std::string ScanText(const ScanView& scan);

// One line per point: stripe, row, detected, column_px, elevation_m, x_m, y_m, hazard.
std::string ScanCsv(const ScanView& scan);

}  // namespace rockyard::report
