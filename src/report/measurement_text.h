// The cells of a measurement for people.
#pragma once

#include <span>
#include <string>

#include "report/run_description.h"
#include "report/summary_text.h"
#include "statistics/cell_summary.h"

namespace rockyard::report {

// Runs, widest intervals, and the cells: every one where they are few, otherwise the main rate
// pooled over all factors but the first two. At most 100 columns.
std::string MeasurementText(const RunDescription& run,
                            const statistics::MeasurementSummary& summary,
                            TextStyle style = TextStyle::kPlain);

// The one of `rates` that text and drawing show where there is room for one; rates.size() where
// none is measured.
std::size_t MainRate(std::span<const truth::MeasuredColumn* const> rates);

}  // namespace rockyard::report
