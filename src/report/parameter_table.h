// Tables of a scenario's parameters: what each value is, where it comes from, how far it may be
// off; and the table of the metrics of statistics/metrics.h. Commands that list parameters or
// metrics print them, and the report page has the values.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/field_table.h"
#include "report/result_table.h"
#include "truth/record.h"

namespace rockyard::report {

// Returns the parameters of one origin, or all.
std::vector<core::ParameterInfo> SelectParameters(std::span<const core::ParameterInfo> parameters,
                                                  std::optional<core::Origin> origin);

// Returns the value of a parameter: a number with six digits, "[1, 2]" for a list.
std::string ParameterValue(const core::ParameterInfo& parameter);

// "lo to hi" where it has a study range, the choices, or "held".
std::string ParameterRange(const core::ParameterInfo& parameter);

// The columns of ParametersCsv, and range.
ResultTable ParameterColumns(std::span<const core::ParameterInfo> parameters);

// One row a parameter: path, value, unit, range ("lo to hi", or the choices), reason or source,
// meaning. Markdown with a header row.
std::string ParametersMarkdown(std::span<const core::ParameterInfo> parameters);

// Columns path, kind, value, unit, origin, study_low, study_high, min, max, choices (separated by
// |), source, doc; RFC 4180.
std::string ParametersCsv(std::span<const core::ParameterInfo> parameters);

// Name, unit, trials that count, definition, record columns, default margin: of every metric of
// records with these columns (statistics::MetricsOf); of drives without plugins by default.
std::string MetricTableText(const truth::RecordSchema& schema = {});  // lines of one metric long
std::string MetricTableMarkdown(
    const truth::RecordSchema& schema = {});  // src/statistics/README.md

}  // namespace rockyard::report
