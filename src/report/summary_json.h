// A run in numbers, for programs: summary.json, which campaigns write and the report page holds,
// and scenario.resolved.json beside it; JSON values that several result files have.
#pragma once

#include <string>

#include "core/json_value.h"
#include "core/provenance.h"
#include "report/run_description.h"
#include "statistics/cell_summary.h"
#include "statistics/drive_summary.h"
#include "statistics/metrics.h"
#include "statistics/proportions.h"

namespace rockyard::report {

// summary.json. Members: schema_version, scenario, seed, fingerprint, settings (what was changed on
// the way from the file; null where that is not known), localization, ablations (in force), trials
// (planned, stored, completed: the contiguous prefix that all else is about, faults), accounting
// and, where the run has them, stopping and shard (run_description.h), declared_success and
// true_success (count, trials, rate, ci95, ci_method), outcomes (every kind), ended_by_limit (a
// rate), declared_success_without_limits (two ends), causes (those that happened,
// truth/end_cause.h), distance_m, path_ratio, dead_reckoning, sim_time_s, energy_wh, columns (all
// others), metrics and metrics_by_outcome, trial_hash, provenance (ProvenanceJson, with threads,
// ranks, builds). A column is {count, min, p05, median, mean, mode, mode_range, mode_method, p95,
// max, std}, where mode_range is no interval of any confidence; a metric (statistics/metrics.h) is
// as MetricJson says; metrics without a value are left out. What is undefined is null, as both ends
// of ci95 are where a mean has none.
core::JsonValue SummaryValue(const RunDescription& run, const statistics::DriveSummary& summary);
std::string SummaryJson(const RunDescription& run, const statistics::DriveSummary& summary);

// summary.json of an experiment that measures: the members of SummaryValue up to accounting,
// stopping and shard, then widest_ci95 (by rate), simultaneous (how the intervals of all cells at
// once are made), planned_cells (how many these are), cells (one object per cell: cell, runs,
// factors, bases, rates with ci95 and ci95_all_cells, means), trial_hash, provenance. No success
// rates: nothing drives.
core::JsonValue MeasurementValue(const RunDescription& run,
                                 const statistics::MeasurementSummary& summary);
std::string MeasurementJson(const RunDescription& run,
                            const statistics::MeasurementSummary& summary);

// The program and the machine: version, commit, compiler, flags, build_type, host, cpu_model,
// cpu_level, cpu_threads.
core::JsonValue ProvenanceJson(const core::Provenance& provenance);

// scenario.resolved.json: {"scenario": every effective value, "fingerprint", "settings",
// "provenance"}. The command line reads it wherever it reads a scenario.
std::string ResolvedScenarioJson(const RunDescription& run);

// Returns why the mean has no interval, in a few words: "3 trials differ from 0, needs 10". Empty
// where it has one.
std::string ReasonOf(const statistics::MeanEstimate& estimate);

// A metric over some trials: {count, mean, ci95} and, where it is no rate, {ci_reason (where ci95
// is null), median, median_ci95, min, max, std, usual, share_apart {count, rate, ci95}}: the
// commonest value, and the trials that have another one, exact. ci_method says how ci95 is made: of
// a rate statistics::MethodName, of a mean skewed_t (statistics/sample_statistics.h); null where
// there is none.
core::JsonValue MetricJson(const statistics::MetricSummary& summary);

// {count, trials, rate, ci95, ci_method}.
core::JsonValue RateJson(const statistics::Proportion& rate);

// The schema_version of summary.json and its like. Members must only ever be added: programs of
// others read them.
inline constexpr int kSchemaVersion = 2;

}  // namespace rockyard::report
