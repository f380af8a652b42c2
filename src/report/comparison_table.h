// The comparison with published values as text, CSV and JUnit, for `rockyard check`; and how its
// numbers are written, in JSON and on the report page too. All that follows ComparisonJUnit is for
// comparison_table.cc, page_sweep.cc and result_json.cc only. Verdicts come from statistics, and
// none of these texts decides an exit code.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/result_table.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::report {

// Returns notes: two on what the columns mean, one on what the verdicts mean, then how the
// comparison was made. Must stay in this order: ComparisonText inserts a note of its own after the
// third.
std::vector<std::string> ComparisonNotes(const statistics::ComparisonResult& result);

// Aligned plain text, at most 100 columns, grouped by scenario, with footnotes on what the columns
// and verdicts mean. Ends with a newline.
std::string ComparisonText(const statistics::PublishedReference& reference,
                           const statistics::ComparisonResult& result);

// RFC 4180, one header line. Statistics shown beside a value follow it with id "<id>/<name>".
std::string ComparisonCsv(const statistics::ComparisonResult& result);

// JUnit: one test case per value; `differs` is a failure, `underpowered` and `not judged` are
// skipped.
std::string ComparisonJUnit(const statistics::PublishedReference& reference,
                            const statistics::ComparisonResult& result);

inline constexpr std::string_view kNotPublishedCase =
    "NOT the published case: run with other settings than the scenario that the reference is about";

bool IsCount(const statistics::PublishedValue& value);

// Three significant digits, "-" where it is not finite.
std::string Number(double value);

// Three decimals, fewer where that says nothing.
std::string PValue(double p);

std::string Power(double power);

// The published number with as many digits as were printed.
std::string Published(const statistics::PublishedValue& value);

// "median (low .. high)".
std::string Prediction(double median, const statistics::Interval& interval, bool count);

// The prediction of a compared value, in the digits of its kind.
std::string Prediction(const statistics::ComparedValue& value);

// The prediction of a statistic that is shown beside a value.
std::string Prediction(const statistics::ComparedValue& value,
                       const statistics::SideStatistic& beside);

// What else is to be said of a value: kinds of failure, one layout for all runs, a remark.
std::vector<std::string> Remarks(const statistics::ComparedValue& value);

// With kFull the other readings of a value follow it, and its remark says what must not be missed
// where rows are read one by one.
enum class ComparisonDetail { kValues, kFull };
ResultTable ComparisonRows(const statistics::ComparisonResult& result, ComparisonDetail detail);

std::string_view RoleName(statistics::ValueRole role);

std::size_t CountOf(const statistics::ComparisonResult& result, statistics::Verdict verdict);

}  // namespace rockyard::report
