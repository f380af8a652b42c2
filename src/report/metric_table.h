// The metrics of statistics/metrics.h as a table.
#pragma once

#include <string>

namespace rockyard::report {

// Name, unit, trials that count, definition, record columns, default margin.
std::string MetricTableText();      // at most 100 columns
std::string MetricTableMarkdown();  // for README.md

}  // namespace rockyard::report
