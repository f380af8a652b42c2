// Two measurements against each other, cell by cell.
#pragma once

#include <string>

#include "report/paired_comparison.h"
#include "statistics/cell_comparison.h"

namespace rockyard::report {

// What was compared; the verdict; a line for each rate; then the cells: those of the main rate (the
// forty with the smallest p-values where there are more), and of every other rate those that
// differ. At most 100 columns.
std::string CellComparisonText(const ComparedRun& first, const ComparedRun& second,
                               const statistics::CellComparison& comparison);

// One line for each rate of each cell: rate, factors, then for A and B count, trials and rate,
// difference, its 95 % interval, the simultaneous one (_all_), p, p after Holm, whether it differs.
std::string CellComparisonCsv(const statistics::CellComparison& comparison);

}  // namespace rockyard::report
