// `rockyard bench report`: entries of one suite beside each other, by the true arrivals of their
// drives. The estimand is fixed: groups of cells (what stands before '/' in their names) are
// weighted alike, and so are the cells of a group. Layouts are the independent units: a layout's
// score is the weighted share of cells in which it ends truly at its goal, and intervals are
// Student's over layouts, also of differences between entries, which have met the same layouts.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "campaign/bench/bench.h"
#include "campaign/bench/scored_cells.h"
#include "core/json_value.h"
#include "report/result_table.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::campaign {

// Of the rules: entries whose scores differ by less are tied, and time and energy part them.
inline constexpr double kTieMargin = 0.02;
// A score against the baseline's has to be seen with this chance (confidence 95 %).
inline constexpr double kToldWith = 0.8;

// A number with its interval, 95 %.
struct Estimated {
  double value = 0.0;
  statistics::Interval interval{};
};

// The mean regret of drives that truly arrive: the way driven and what is left to the goal, over
// the way of an optimist with perfect eyes (bench_regret.h), less 1. NaN where no drive has one.
// Drives weigh as their cells; the interval is over layouts, of the ratio of sums that the mean is.
struct Regret {
  Estimated mean;
  std::int64_t drives = 0;
};

// What is known of an entry beside the baseline.
enum class Verdict { kBetter, kWorse, kTied, kUnknown };

// Limits of patience at which arrivals are told, m: what the rover drives between two progresses
// towards its goal (no_progress_distance_m of truth/drive_record.h). One run gives them all.
inline constexpr std::array<double, 4> kPatience_m{5.0, 10.0, 20.0, 40.0};

// Of one entry in one group, or in one cell.
struct ScoredPart {
  std::string name;
  double arrived = 0.0;   // weighted share of drives that end truly at the goal
  double baseline = 0.0;  // of the baseline there
  Estimated difference;
  Regret regret;
};

struct Standing {
  BenchRun run;
  Estimated score;
  Estimated difference;  // to the baseline; 0 of the baseline itself
  Verdict verdict = Verdict::kTied;
  double told = 0.0;  // the smallest difference to the baseline that would be told (kToldWith)
  // Ranks that are possible, 1 the best: all pairs of entries at once, 95 % (Bonferroni).
  int best_rank = 1;
  int worst_rank = 1;
  std::set<std::string> not_told_from;  // names of others, by the same comparison
  // Weighted shares of drives. Unsafe: tipped over, or ended with the body on a rock.
  double unsafe = 0.0;
  Estimated unsafe_difference;  // to the baseline
  bool passes_gate = true;  // false: surely more unsafe drives than the baseline's, by kTieMargin
  double scraped = 0.0;     // body contact with a rock
  double declared = 0.0;    // believed to be at the goal, truly or not
  Regret regret;
  // Of drives in which both arrived truly: sums over those of the baseline.
  double way_ratio = 1.0;
  double time_ratio = 1.0;
  double energy_ratio = 1.0;
  std::array<double, kPatience_m.size()> arrived_within{};      // weighted shares, by kPatience_m
  std::array<double, truth::kTrialOutcomeNames.size()> ends{};  // the same, by outcome
  std::vector<ScoredPart> groups;
  std::vector<ScoredPart> cells;
  ScoredCells drives;
};

struct Standings {
  std::string suite;
  std::int64_t layouts = 0;
  std::vector<Standing> entries;  // the best score first
  std::string baseline;           // its name
  std::string why_no_regret;      // a sentence where no entry has one

  report::ResultTable Table() const;   // a row for each entry
  report::ResultTable Groups() const;  // a row for each entry and group
  report::ResultTable Cells() const;   // a row for each entry and cell
  report::ResultTable Ends() const;    // a row for each entry and end, and limit of patience
  std::string Markdown() const;
};

// Returns the standings. `folders`: runs of entries; the first is the baseline. Throws
// core::UserError where they are not of the same suite, layouts, computing and seed, or two
// have one name.
Standings MakeStandings(const std::vector<std::filesystem::path>& folders);

}  // namespace rockyard::campaign

namespace rockyard::core {

template <>
struct EnumNames<campaign::Verdict> {
  static constexpr std::array<std::string_view, 4> kNames{"better", "worse", "tied", "unknown"};
};

}  // namespace rockyard::core
