// A sweep for people and for programs: the files that its campaign writes when it ends, and its
// table on the terminal. No store depends on them: a merge makes them anew.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "core/provenance.h"
#include "report/summary_text.h"
#include "report/sweep_summary.h"
#include "scenario/sweep.h"

namespace rockyard::report {

// What a report says of a campaign besides its cells.
struct SweepDescription {
  std::string trial_hash;  // over all cells
  core::Provenance provenance = {};
  std::vector<std::string> builds = {};
  int threads = 1;
};

// cells.csv: one line per cell: cell, name, the axes, seed, planned, stored, completed, faults,
// every outcome, for declared and true success: rate, 95 % interval, and the interval that holds
// for all cells at once; hash; pending trials and failures of the machine; and with a stopping rule
// where it ended the cell ("precise", "max_trials", "budget", "open"), after how many trials, and
// the interval of declared success there; the drives that a limit ended.
std::string SweepCellsCsv(const scenario::Sweep& sweep, const SweepSummary& summary);

// curves.csv: one line per cell and metric (statistics/metrics.h): cell, the axes, metric, unit, n,
// mean (the rate, of a rate) with its 95 % interval, median with its own. Empty where undefined.
std::string SweepCurvesCsv(const scenario::Sweep& sweep, const SweepSummary& summary);

// fit.csv: the fitted curves with their pointwise 95 % bands at the numbers of FittedLine: curve,
// success (declared or true), x, rate, low, high.
std::string SweepFitCsv(const SweepSummary& summary);

// fits.csv: one line per curve and success: status, scale, coefficients, covariance, deviance with
// degrees of freedom and p, and the numbers at which 90 % and 50 % succeed with 95 % intervals and
// whether they lie outside of the settings, and of how many clusters of dependent trials the
// covariance knows (0: trials are independent).
std::string SweepFitsCsv(const SweepSummary& summary);

// differences.csv: one line per pair of levels and success.
std::string SweepDifferencesCsv(const SweepSummary& summary);

// success.svg: success against the numbers of the fit axis: points with interval bars, fitted
// curves with bands, one colour and one mark per curve; declared and true success side by side.
// Empty where the sweep has no curve of at least two cells.
std::string SweepSvg(const scenario::Sweep& sweep, const SweepSummary& summary);

// The table for the terminal, at most 100 columns wide.
std::string SweepText(const scenario::Sweep& sweep, const SweepSummary& summary,
                      const SweepDescription& description, TextStyle style);

// summary.json of a sweep: schema_version, kind "sweep", name, seed, common_random_numbers, axes,
// trials (planned, stored, completed, faults), accounting, cells (with the rule and where it
// ended each), fits, differences, attribution, notes,
// trial_hash, provenance. What is undefined or infinite is null.
core::JsonValue SweepValue(const scenario::Sweep& sweep, const SweepSummary& summary,
                           const SweepDescription& description);
std::string SweepJson(const scenario::Sweep& sweep, const SweepSummary& summary,
                      const SweepDescription& description);

// Writes sweep.json, summary.json, all files above and, where there is one, attribution.csv
// (attribution.h), each whole or not at all. Throws core::UserError where one cannot be written.
// Must agree: every file written here stands in kDerivedFiles of campaign/open_run.cc, by which
// --force sets the files of a run aside.
void WriteSweepFiles(const std::filesystem::path& folder, const scenario::Sweep& sweep,
                     const SweepSummary& summary, const SweepDescription& description);

}  // namespace rockyard::report
