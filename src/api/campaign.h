/// @file
/// What the command does with whole campaigns, for other programs: run, sweep, merge, report,
/// check, compare, baseline. Only programs that link rockyard use it. One trial again is
/// campaign/replay.h. Must stay, for programs that are written: names, order of members (which
/// initializers follow), and defaults.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/scenario.h"
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
  /// "I/N", 1 <= I <= N: of every cell the trials t with t mod N = I - 1 alone, for Merge. Empty:
  /// all.
  std::string shard = {};
  /// The values that the file leaves out, and the navigators and estimators that it may name.
  Scenario defaults = {};
  /// What the program that calls is known by: a name and a version, or a hash of its own code.
  /// Stores keep it beside the build of rockyard: another one may not go on with the run. Empty
  /// where the program adds nothing that decides.
  std::string program = {};
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
/// supervisor: one that hangs or crashes takes the process with it, so that plugins of shared
/// libraries are refused. Records depend on scenario, seed and index alone, not on threads, order,
/// or where earlier calls stopped.
campaign::WorkResult Run(const RunRequest& request);

/// Runs a sweep file in the same way: scenarios that differ along axes, as one campaign.
campaign::WorkResult Sweep(const RunRequest& request);

/// Shards of one campaign, to be put together.
struct MergeRequest {
  std::vector<std::filesystem::path> shards;  ///< folders of runs with RunRequest::shard
  std::filesystem::path folder;               ///< a new one
  bool partial = false;  ///< shards or trials may be missing: they are pending then
  campaign::Observer observer = {};
};

/// Writes the folder of the whole campaign, the same as if it had run in one: the store, and all
/// that follows from it. Never throws. kBadInput, and nothing written: a folder that is no shard,
/// shards of different campaigns or builds, one that is missing or there twice, a folder that holds
/// something else. kFailed: the store is there, and a file that follows from it is not. What is
/// returned counts no trials; summary.json in the folder does. Memory: the records of one campaign.
campaign::WorkResult Merge(const MergeRequest& request);

/// Runs and sweeps that a page for a browser is to show.
struct ReportRequest {
  std::vector<std::string> runs;         ///< folders; runs are compared with the first
  std::string cell = {};                 ///< of a campaign, that one alone: its name or number
  std::filesystem::path page = {};       ///< empty: report.html in the folder that is named first
  std::filesystem::path data = {};       ///< the numbers of the page as JSON; empty: no such file
  std::filesystem::path reference = {};  ///< published values; empty: those of results/reference
  std::string title = {};                ///< empty: the scenarios of the runs
  /// Replays beside the page: of the worst failed trials of each run, or of each sweep, and of each
  /// outcome of a run. 0: none.
  std::size_t replays = 5;
  std::size_t tracks = 100;  ///< trials of each run that are driven again for its map; 0: none
  bool plugins = false;      ///< whether runs in which a plugin decides are driven again for these
  /// Is asked while trials are driven again. True: the page is written without the rest.
  std::function<bool()> stop = {};
  campaign::Observer observer = {};
};

/// Writes the page, and the replays into a folder beside it. Never throws. kDiffers: a trial that
/// was driven again is not the stored one; its replay is left out. Memory: the records of one run
/// or cell at a time. Cost: that of the trials that are driven again, and some seconds for
/// published values.
campaign::WorkResult Report(const ReportRequest& request);

/// Runs that are held against published values or a baseline.
struct CheckRequest {
  std::vector<std::string> runs;    ///< folders of runs, or of such folders
  std::filesystem::path reference;  ///< file with published values, or with a baseline
  /// The cell of each campaign: its name or number. Empty: for published values campaigns of one
  /// cell alone, for a baseline all cells.
  std::string cell = {};
};

/// Finished runs whose results are kept for later builds to be held against.
struct BaselineRequest {
  std::vector<std::string> runs;  ///< folders of runs of drives, or of such folders
  std::filesystem::path file;     ///< to write; one that is there is replaced
  std::string name;               ///< of the baseline
  std::string reason;             ///< why its numbers may be what they are; not empty
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

/// Writes a baseline, which Check takes as its reference. Throws core::UserError, and leaves the
/// file as it is: runs that are no drives, unfinished, of the same name, or with trials that share
/// rocks; a file that cannot be written. Memory: the records of one campaign.
void WriteBaseline(const BaselineRequest& request);

/// Compares two runs. Drives are compared trial by trial where their seeds are the same, which
/// describes and decides nothing (kDone); measurements cell by cell, with kDiffers where a rate of
/// a cell differs. Throws core::UserError. Memory: of drives 200 bytes a trial of each run and some
/// columns; of measurements the records of both.
Finding Compare(const CompareRequest& request);

}  // namespace rockyard::api
