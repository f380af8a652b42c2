// The main rate of a measurement as curves.
#pragma once

#include <string>

#include "statistics/cell_summary.h"

namespace rockyard::report {

// An SVG of the main rate (measurement_text.h) against the first factor. Curves: third factor.
// Panels: second factor across, fourth factor down. Bands: the 95 % interval of each cell. Empty
// where no rate is measured or the first factor has a single value.
std::string CellsSvg(const statistics::MeasurementSummary& summary, const std::string& title);

}  // namespace rockyard::report
