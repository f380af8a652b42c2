// The cells of a measurement as a table.
#pragma once

#include <string>

#include "statistics/cell_summary.h"

namespace rockyard::report {

// cells.csv: one line per cell: cell, runs, factors, bases; for each rate <name>, <name>_low and
// <name>_high (95 % interval of this cell), <name>_all_low and <name>_all_high (95 % for all cells
// at once, Bonferroni); then mean_<name> or rms_<name>.
std::string CellsCsv(const statistics::MeasurementSummary& summary);

}  // namespace rockyard::report
