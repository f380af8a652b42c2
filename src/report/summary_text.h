// A run in numbers, for people.
#pragma once

#include <string>

#include "report/run_description.h"
#include "statistics/drive_summary.h"

namespace rockyard::report {

enum class TextStyle { kPlain, kColour };

// Some 20 lines of at most 100 columns: trials, rates with intervals, outcomes, the main columns,
// the trial hash. Colours are ANSI escape sequences.
std::string SummaryText(const RunDescription& run, const statistics::DriveSummary& summary,
                        TextStyle style = TextStyle::kPlain);

}  // namespace rockyard::report
