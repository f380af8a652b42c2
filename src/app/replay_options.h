// What `rockyard replay` is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "campaign/trial_source.h"

namespace rockyard::app {

struct ReplayOptions {
  campaign::TrialRequest request;
  std::optional<std::int64_t> scan;
  std::optional<std::int64_t> step;
  bool list = false;
  std::string out;   // page, or folder of a scan or step; empty: the command chooses
  std::string svg;   // plan view
  std::string data;  // what the page is given

  bool draws() const { return scan || step; }
};

}  // namespace rockyard::app
