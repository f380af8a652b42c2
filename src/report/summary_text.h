// A run in numbers, for people: what the terminal shows when a campaign ends. The cells of a
// measurement also as CSV and as curves. Wording and layout are free; columns of cells.csv are for
// programs of others.
#pragma once

#include <cstddef>
#include <string>

#include "report/run_description.h"
#include "statistics/cell_summary.h"
#include "statistics/drive_summary.h"

namespace rockyard::report {

enum class TextStyle { kPlain, kColour };

// Some 20 lines of at most 100 columns: trials, rates with intervals, outcomes, the main columns,
// the trial hash. Colours are ANSI escape sequences.
std::string SummaryText(const RunDescription& run, const statistics::DriveSummary& summary,
                        TextStyle style = TextStyle::kPlain);

// How many factors of a cell are shown beside its numbers.
inline constexpr std::size_t kMaxFactors = 4;

// Returns text of at most 100 columns on the runs and cells of a measurement. A cell alone has
// every rate, with its interval, and every mean. Otherwise the text has the widest interval of the
// main rate, and the first columns of every cell or, where they are many, that rate pooled over all
// factors but the first two.
std::string MeasurementText(const RunDescription& run,
                            const statistics::MeasurementSummary& summary,
                            TextStyle style = TextStyle::kPlain);

// Returns the place of the first of `rates` that the experiment calls its main one, which text and
// drawing show where there is room for one; rates.size() where there is none.
std::size_t MainRate(const truth::RecordSchema& rates);

// cells.csv: one line per cell: cell, runs, factors, bases; for each rate <name>, <name>_low and
// <name>_high (95 % interval of this cell), <name>_all_low and <name>_all_high (95 % for all cells
// at once, Bonferroni); then mean_<name> or rms_<name>.
std::string CellsCsv(const statistics::MeasurementSummary& summary);

// cells.svg: the main rate against the first factor. Curves: third factor. Panels: second factor
// across, fourth factor down. Bands: the 95 % interval of each cell. Empty where no rate is
// measured or the first factor has a single value.
std::string CellsSvg(const statistics::MeasurementSummary& summary, const std::string& title);

}  // namespace rockyard::report
