// How numbers of a check against a baseline are written. For regression_*.cc only.
#pragma once

#include <string>
#include <string_view>

#include "report/regression_report.h"
#include "statistics/regression.h"

namespace rockyard::report {

std::string_view Name(statistics::RegressionVerdict verdict);
std::string Signed(double value);  // FourDigits with its sign
std::string Probability(double p);
std::string Label(const statistics::RegressionRow& row);  // "cell: metric"

// That the build of the baseline gave this cell other records.
std::string NotDeterministic(const CheckedCell& cell);

// Which metric moved, by how much, and whether the run was large enough to know.
std::string Sentence(const statistics::RegressionRow& row);

}  // namespace rockyard::report
