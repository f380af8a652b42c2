// How numbers of a check against a baseline are written. For regression_*.cc and
// result_json.cc only.
#pragma once

#include <string>
#include <string_view>

#include "report/regression_report.h"
#include "report/result_table.h"
#include "statistics/regression.h"

namespace rockyard::report {

// One row per metric and cell.
ResultTable RegressionTable(const RegressionReport& report);

std::string_view Name(statistics::RegressionVerdict verdict);
std::string Signed(double value);  // FourDigits with its sign
std::string Probability(double p);
std::string Label(const statistics::RegressionRow& row);  // "cell: metric"

// "outcome 34, scans 31, ...": the columns that differ in most trials.
std::string Columns(const RecordChanges& changes);

// Both findings in a word each.
std::string_view Name(RecordFinding finding);
std::string_view DistributionName(const statistics::RegressionResult& result);

// That the build of the baseline gave this cell other records.
std::string NotDeterministic(const CheckedCell& cell);

// Which metric moved, by how much, and whether the run was large enough to know.
std::string Sentence(const statistics::RegressionRow& row);

}  // namespace rockyard::report
