// What has become of the planned trials, and why there are no more.
#pragma once

#include <string>

#include "report/run_description.h"

namespace rockyard::report {

// {"accounting": {planned, completed, faulted, pending, infrastructure_faults}} and, where the run
// has them, "stopping" (the rule, where it ended, the confidence sequence there) and "shard".
std::string AccountingJson(const RunDescription& run);

// A line for the terminal that adds up, and one for the rule.
std::string AccountingText(const RunDescription& run);

// summary.json of a shard: no rates, since its trials are no contiguous prefix.
std::string ShardJson(const RunDescription& run);

// The same for the terminal, with what to do next.
std::string ShardText(const RunDescription& run);

}  // namespace rockyard::report
