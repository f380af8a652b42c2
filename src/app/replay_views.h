// What `rockyard replay` is asked for; scans and steps of a trial, listed or drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/console.h"
#include "campaign/trial_source.h"

namespace rockyard::app {

struct ReplayOptions {
  campaign::TrialRequest request;
  std::string with;  // what the second trial is of; empty: the same
  std::optional<std::uint32_t> with_trial;
  std::optional<std::int64_t> scan;
  std::optional<std::int64_t> step;
  bool list = false;
  std::string out;   // page, or folder of a scan or step; empty: the command chooses
  std::string svg;   // plan view
  std::string data;  // what the page is given

  bool draws() const { return scan || step; }

  // The trial beside the first, where one is asked for: the same trial of another run, another one
  // of the same, or another one of another run. Settings of --set are those of the first.
  std::optional<campaign::TrialRequest> Beside() const {
    if (with.empty() && !with_trial) return std::nullopt;
    campaign::TrialRequest beside = request;
    beside.trial = with_trial.value_or(request.trial);
    if (with.empty()) return beside;
    beside.source = with;
    beside.overrides.clear();
    return beside;
  }
};

// Runs the trial again. Draws the scan or step that the options name into a folder, or else lists
// all of them. kDiffers where the record is not the stored one. Throws core::UserError.
ExitCode ShowViews(const ReplayOptions& options);

}  // namespace rockyard::app
