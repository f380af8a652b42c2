// What has become of the planned trials, and why there are no more.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "report/run_description.h"

namespace rockyard::report {

// {"accounting": {planned, completed, faulted, pending, infrastructure_faults}} and, where the run
// has them, "stopping" (the rule, where it ended, the interval there) and "shard".
core::JsonValue AccountingJson(const RunDescription& run);

// The same of a cell.
core::JsonValue AccountingJson(const Accounting& accounting,
                               const std::optional<StoppingReport>& stopping);

// A line for the terminal that adds up, and one for failures of the machine.
std::string AccountingText(const Accounting& accounting);

// The same, and lines for the rule.
std::string AccountingText(const RunDescription& run);

// A line that keeps a changed scenario from being taken for that of its name; empty where nothing
// was changed, or that is not known.
std::string SettingsText(const RunDescription& run);

// Cells of a campaign together.
Accounting Sum(const Accounting& first, const Accounting& second);

// Where the rule ended a cell, in some words: "precise enough after 40 trials, 1.0 .. 12.3 %".
std::string StoppingPhrase(const StoppingReport& stopping);

// What a shard of a campaign of cells has.
struct ShardCell {
  std::string name;
  Accounting accounting;
};
std::string ShardCampaignJson(const std::string& name, int index, int count,
                              const std::vector<ShardCell>& cells);

// summary.json of a shard: no rates, since its trials are no contiguous prefix.
std::string ShardJson(const RunDescription& run);

// The same for the terminal, with what to do next.
std::string ShardText(const RunDescription& run);

}  // namespace rockyard::report
