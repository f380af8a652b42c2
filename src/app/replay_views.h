// The options of the command `replay`, and what it does with --list, --scan and --step: lists or
// draws scans of the light stripe and steps of a map-based navigator.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/console.h"
#include "campaign/trial_source.h"

namespace rockyard::app {

// What the parser fills.
struct ReplayOptions {
  campaign::TrialRequest request;
  std::string with;  // scenario or run of the second trial; empty: that of the first
  std::optional<std::uint32_t> with_trial;
  std::optional<std::int64_t> scan;
  std::optional<std::int64_t> step;
  bool list = false;
  std::string out;   // page, or folder of a scan or step; empty: the command chooses
  std::string svg;   // plan view
  std::string data;  // what the page is given

  bool draws() const { return scan || step; }

  // Returns the second trial of the page, where one is asked for: of `with`, else of the source of
  // the first; with the index with_trial, else that of the first. The settings of --set hold for it
  // only where its source is that of the first.
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

// Runs the trial again, and draws the scan or step that the options name into a folder, or lists
// all where they name none. Returns the outcome of campaign::ReplayMoments.
ExitCode ShowViews(const ReplayOptions& options);

}  // namespace rockyard::app
