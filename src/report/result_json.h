// What `rockyard check --json` and `rockyard compare --json` print: one object each, whose shape is
// described in README.md of this folder. What is undefined is null. Programs of others read the
// objects: members must only ever be added.
#pragma once

#include <span>
#include <string>

#include "report/page_data.h"
#include "report/paired_comparison.h"
#include "report/regression_report.h"
#include "statistics/cell_summary.h"
#include "statistics/published_comparison.h"

namespace rockyard::report {

// Runs against published values. `exit_code`: of the command.
std::string PublishedCheckJson(const statistics::PublishedReference& reference,
                               const statistics::ComparisonResult& result, int exit_code);

// Runs against a baseline: every metric, equivalent ones too.
std::string BaselineCheckJson(const RegressionReport& report, int exit_code);

// Two runs of drives.
std::string DriveComparisonJson(const PageComparison& comparison);

// Two runs that measure.
std::string CellComparisonJson(const ComparedRun& first, const ComparedRun& second,
                               const statistics::CellComparison& cells, int exit_code);

}  // namespace rockyard::report
