// What runs gave, kept for later builds to be held against it.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "report/baseline.h"

namespace rockyard::campaign {

struct BaselineRequest {
  std::vector<std::string> runs;  // folders of runs of drives, or of such folders
  std::string name;
  std::string reason;  // why its numbers may be what they are
};

// Of finished runs with independent trials and names of their own. Memory: the records of one
// campaign.
core::Result<report::Baseline> MakeBaseline(const BaselineRequest& request);

}  // namespace rockyard::campaign
