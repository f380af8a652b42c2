// Published values that are judged by a tolerance: what their members must say together.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "statistics/published_values.h"

namespace rockyard::report {

// For any value: a value without a tolerance must not have members of one. `path` ends with a dot.
std::vector<core::Problem> ToleranceProblems(const statistics::PublishedValue& value,
                                             const std::string& path);

}  // namespace rockyard::report
