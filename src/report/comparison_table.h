// The comparison with published values for people and for machines.
#pragma once

#include <string>
#include <vector>

#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::report {

// What its columns mean (2), what its verdicts mean (1), and how it was made.
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

}  // namespace rockyard::report
