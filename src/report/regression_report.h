// What a check against a baseline found, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "statistics/regression.h"

namespace rockyard::report {

// How one cell was compared.
struct CheckedCell {
  std::string name;
  bool identical = false;  // same trials, same hash: every bit is the same
  // The same build and settings, and yet another hash: the program is not deterministic.
  bool not_deterministic = false;
  bool paired = false;
  std::uint64_t baseline_seed = 1;
  std::uint64_t run_seed = 1;
  std::int64_t baseline_trials = 0;
  std::int64_t run_trials = 0;
  std::int64_t same_pairs = 0;  // same outcome, same value of every metric as the baseline keeps it
  bool same_fields = true;      // scenario settings that decide rocks, start and goal
};

struct RegressionReport {
  std::string baseline;  // its name
  std::string reason;    // why it was made
  std::string baseline_build;
  std::string run_build;
  std::vector<CheckedCell> cells;
  std::vector<std::string> notes;
  statistics::RegressionResult result;
};

// In any cell: itself a difference, whatever the metrics say.
bool BrokenDeterminism(const RegressionReport& report);

// At most 100 columns: how each cell was compared, every metric that is not equivalent (all of them
// with `all_rows`), what moved and by how much, what could not be told and how many trials would
// tell it, the declared error rates.
enum class ReportedRows { kNotEquivalent, kAll };
std::string RegressionText(const RegressionReport& report,
                           ReportedRows rows = ReportedRows::kNotEquivalent);

// One line per metric and cell.
std::string RegressionCsv(const RegressionReport& report);

// A test case per metric and cell: failed where changed, skipped where inconclusive; and a failed
// one per cell that is not deterministic.
std::string RegressionJUnit(const RegressionReport& report);

}  // namespace rockyard::report
