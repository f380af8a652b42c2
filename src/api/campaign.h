/// @file
/// What the command does with whole campaigns, for other programs: run, sweep, check, compare. Only
/// programs that link rockyard use it. One trial again is campaign/replay.h. Must stay, for
/// programs that are written: names, order of members (which initializers follow), and defaults.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "campaign/work.h"

namespace rockyard::api {

/// A campaign: the trials of a scenario, or of every cell of a sweep.
struct RunRequest {
  /// A scenario file, a scenario.resolved.json or the folder of a run; for Sweep a sweep file.
  std::filesystem::path source;
  std::vector<std::string> overrides = {};  ///< "PATH=VALUE", applied in order
  std::optional<std::int64_t> trials = {};  ///< of each cell; absent: the file's
  std::optional<std::int64_t> seed = {};    ///< absent: the file's
  std::filesystem::path folder = {};        ///< empty: results/runs/<name>-seed<seed>
  campaign::ExistingRun existing = campaign::ExistingRun::kRefuse;
  int threads = 0;                   ///< 0: as many as the machine runs at once
  double max_fault_fraction = 0.01;  ///< simulator faults above it: kTooManyFaults
  /// Rules by which trials are chosen that leave a trace: "all", "failures", "worst:N", "share:P".
  std::vector<std::string> traces = {};

  /// Is told about twice a second, by one thread at a time, how many of the planned trials have
  /// finished.
  std::function<void(std::int64_t finished, std::int64_t planned)> progress = {};
  /// Is asked before the first and after every trial, by several threads at once. Where it returns
  /// true, trials in flight end and are stored, and no more begin.
  std::function<bool()> stop = {};
  campaign::Observer observer = {};
};

/// Runs what the folder lacks of the trials and writes results.sqlite, summary.json, trials.csv and
/// what else follows from them. Never throws. Trials run on threads of this process, without a
/// supervisor: one that hangs or crashes takes the process with it. Records depend on scenario,
/// seed and index alone, not on threads, order, or where earlier calls stopped. Limit: the
/// navigators and estimators are those of rockyard.
campaign::WorkResult Run(const RunRequest& request);

/// Runs a sweep file in the same way: scenarios that differ along axes, as one campaign.
campaign::WorkResult Sweep(const RunRequest& request);

/// Runs that are held against published values or a baseline.
struct CheckRequest {
  std::vector<std::string> runs;    ///< folders of runs, or of such folders
  std::filesystem::path reference;  ///< file with published values, or with a baseline
  /// The cell of each campaign: its name or number. Empty: for published values campaigns of one
  /// cell alone, for a baseline all cells.
  std::string cell = {};
};

/// Two runs that are held against each other.
struct CompareRequest {
  std::filesystem::path first;   ///< folder of a run
  std::filesystem::path second;  ///< folder of a run
  std::string cell = {};  ///< of both, where they are campaigns of several: its name or number
  std::string second_cell = {};  ///< of the second, where it is another cell
};

/// What was found. The outcome is kDone, kDiffers, or kInconclusive where a check cannot decide.
struct Finding {
  campaign::Outcome outcome = campaign::Outcome::kDone;
  /// One JSON object, the same that `rockyard check --json` and `rockyard compare --json` print.
  std::string json;
};

/// Compares runs with published values, which need one run of each scenario, or with a baseline,
/// which needs one run of each of its cells. Throws core::UserError. Cost: that of the resampling,
/// some seconds. The resampling has a seed of its own, so that equal runs give equal findings.
Finding Check(const CheckRequest& request, const campaign::Observer& observer = {});

/// Compares two runs. Drives are compared trial by trial where their seeds are the same, which
/// describes and decides nothing (kDone); measurements cell by cell, with kDiffers where a rate of
/// a cell differs. Throws core::UserError. Memory: of drives 200 bytes a trial of each run and some
/// columns; of measurements the records of both.
Finding Compare(const CompareRequest& request);

}  // namespace rockyard::api
