// What a check against a baseline found (`rockyard check`), for people and for programs. All that
// follows RegressionJUnit says how its numbers are written and is for regression_report.cc and
// result_json.cc only. FindingOfRecords and BrokenDeterminism also decide exit codes
// (campaign/check.cc); all else is free wording but for names and columns.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/result_table.h"
#include "statistics/regression.h"

namespace rockyard::report {

// Whether the records themselves are other ones: a question of bits, which no metric answers, and
// which can be asked of pairs only.
struct RecordChanges {
  // A metric, or "outcome", and in how many pairs it differs.
  struct Column {
    std::string name;
    std::int64_t trials = 0;
  };
  std::int64_t pairs = 0;       // compared; 0 where the trials are no pairs
  std::int64_t trials = 0;      // of these with another outcome or value, as the baseline keeps it
  std::vector<Column> columns;  // that differ, most trials first
  // The same trials, the same values, and yet another hash: last digits, or columns that the
  // baseline does not keep.
  bool only_hash = false;

  bool any() const { return trials > 0 || only_hash; }
};

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
  RecordChanges records = {};
  bool same_fields = true;  // scenario settings that decide rocks, start and goal
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

// Whether any cell is not deterministic, which is itself a difference, whatever the metrics say.
bool BrokenDeterminism(const RegressionReport& report);

// The finding on records, of all cells together. A check has a second one, on distributions
// (DistributionName). Neither stands for the other: a rewritten sum changes every record and no
// distribution, and with other seeds a changed distribution shows in no record.
enum class RecordFinding {
  kSame,           // every bit; of fewer trials, outcomes and the values that the baseline keeps
  kChanged,        // of at least one cell
  kNotComparable,  // other seeds or fields: of at least one cell, and no change in the others
};
RecordFinding FindingOfRecords(const RegressionReport& report);

// kThatMatter: primary metrics that are not equivalent, and secondary ones that changed.
enum class ReportedRows { kThatMatter, kAll };
// Returns text of at most 100 columns: how each cell was compared, a table of metrics, what moved
// and by how much, what could not be told and how many trials would tell it, both findings, the
// declared error rates.
std::string RegressionText(const RegressionReport& report,
                           ReportedRows rows = ReportedRows::kThatMatter);

// One line per metric and cell.
std::string RegressionCsv(const RegressionReport& report);

// A test case per metric and cell: failed where changed, skipped where inconclusive, else passed;
// and a failed one per cell that is not deterministic.
std::string RegressionJUnit(const RegressionReport& report);

// One row per metric and cell.
ResultTable RegressionTable(const RegressionReport& report);

std::string_view Name(statistics::RegressionVerdict verdict);
std::string Signed(double value);  // FourDigits with its sign
std::string Probability(double p);
std::string Label(const statistics::RegressionRow& row);  // "cell: metric"

// "outcome 34, scans 31, ...": the columns that differ in most trials.
std::string Columns(const RecordChanges& changes);

// Both findings, on records and on distributions, in a word each.
std::string_view Name(RecordFinding finding);
std::string_view DistributionName(const statistics::RegressionResult& result);

// A sentence: the build of the baseline itself gave this cell other records.
std::string NotDeterministic(const CheckedCell& cell);

// Which metric moved, by how much, and whether the run was large enough to know.
std::string Sentence(const statistics::RegressionRow& row);

}  // namespace rockyard::report
