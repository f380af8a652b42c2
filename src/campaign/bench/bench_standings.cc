#include "campaign/bench/bench_standings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "batch/result_store.h"
#include "campaign/bench/bench_regret.h"
#include "core/error.h"
#include "statistics/equivalence.h"
#include "truth/record.h"

namespace rockyard::campaign {
namespace {

using statistics::MeanDifference;

constexpr double kAlpha = 0.05;
// Quantiles of the normal law at 1 - kAlpha / 2 and at kToldWith: a difference of so many standard
// errors in all is seen with that chance.
constexpr double kToldErrors = 1.959964 + 0.841621;

using Flag = bool ScoredDrive::*;

bool IsIn(const ScoredCell& cell, const std::string& group) {
  return group.empty() || GroupOf(cell.name) == group;
}

// Returns the score of each layout, over the cells of one group or of all ("").
std::vector<double> Scores(const ScoredCells& cells, Flag flag, const std::string& group = "") {
  std::vector<double> scores(cells.front().drives.size(), 0.0);
  double total = 0.0;
  for (const ScoredCell& cell : cells) {
    if (!IsIn(cell, group)) continue;
    total += cell.weight;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (cell.drives[i].*flag) scores[i] += cell.weight;
    }
  }
  for (double& score : scores) score /= total;
  return scores;
}

std::vector<double> Less(std::vector<double> scores, const std::vector<double>& others) {
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i] -= others[i];
  return scores;
}

Estimated Estimate(const MeanDifference& means, double confidence = 1.0 - kAlpha) {
  return {means.difference, statistics::DifferenceInterval(means, confidence)};
}

Estimated Estimate(const std::vector<double>& scores) {
  return Estimate(statistics::PairedMeans(scores));
}

double MeanOf(const std::vector<double>& scores) {
  return statistics::PairedMeans(scores).difference;
}

// Returns the mean regret over drives, weighted as their cells: a ratio of two sums over layouts,
// whose standard error is that of its residuals (Cochran 1977, Sampling Techniques, sec. 6.4).
Regret RegretOf(const ScoredCells& cells, const std::string& group = "") {
  struct Sums {
    double regret = 0.0;
    double weight = 0.0;
  };
  std::vector<Sums> layouts(cells.front().drives.size());
  Sums all;
  Regret regret;
  for (const ScoredCell& cell : cells) {
    if (!IsIn(cell, group)) continue;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      if (std::isnan(cell.drives[i].regret)) continue;
      layouts[i].regret += cell.weight * cell.drives[i].regret;
      layouts[i].weight += cell.weight;
      all.regret += cell.weight * cell.drives[i].regret;
      all.weight += cell.weight;
      ++regret.drives;
    }
  }
  // Layouts in which nothing arrives say nothing.
  std::erase_if(layouts, [](const Sums& of) { return of.weight == 0.0; });
  const double mean = all.regret / all.weight;
  const double mean_weight = all.weight / static_cast<double>(layouts.size());
  std::vector<double> values;
  values.reserve(layouts.size());
  for (const Sums& of : layouts) {
    values.push_back(mean + (of.regret - mean * of.weight) / mean_weight);
  }
  regret.mean = Estimate(values);
  return regret;
}

Verdict VerdictOf(const MeanDifference& means) {
  if (statistics::EquivalencePValue(means, kTieMargin) <= kAlpha) return Verdict::kTied;
  const Estimated difference = Estimate(means);
  if (difference.interval.low > 0.0) return Verdict::kBetter;
  if (difference.interval.high < 0.0) return Verdict::kWorse;
  return Verdict::kUnknown;
}

// Sum over the drives in which both arrived, over that of the baseline.
double RatioOf(const ScoredCells& cells, const ScoredCells& baseline, double ScoredDrive::*value) {
  double own = 0.0;
  double others = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < cells[c].drives.size(); ++i) {
      const ScoredDrive& drive = cells[c].drives[i];
      const ScoredDrive& other = baseline[c].drives[i];
      if (!drive.arrived || !other.arrived) continue;
      own += drive.*value;
      others += other.*value;
    }
  }
  return own / others;
}

// Returns the parts of the score: groups, or cells.
std::vector<ScoredPart> PartsOf(const ScoredCells& cells, const ScoredCells& baseline,
                                bool by_group) {
  std::vector<ScoredPart> parts;
  std::set<std::string> done;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string name = by_group ? GroupOf(cells[c].name) : cells[c].name;
    if (!done.insert(name).second) continue;
    const auto scores = [&](const ScoredCells& of) {
      return by_group ? Scores(of, &ScoredDrive::arrived, name)
                      : Scores({of[c]}, &ScoredDrive::arrived);
    };
    const std::vector<double> own = scores(cells);
    const std::vector<double> others = scores(baseline);
    parts.push_back({name, MeanOf(own), MeanOf(others), Estimate(Less(own, others)),
                     by_group ? RegretOf(cells, name) : RegretOf({cells[c]})});
  }
  return parts;
}

void SetEnds(Standing& standing, const ScoredCells& cells) {
  for (const ScoredCell& cell : cells) {
    const double share = cell.weight / static_cast<double>(cell.drives.size());
    for (const ScoredDrive& drive : cell.drives) {
      standing.ends.at(static_cast<std::size_t>(drive.outcome)) += share;
      for (std::size_t i = 0; drive.arrived && i < kPatience_m.size(); ++i) {
        if (drive.no_progress_m <= kPatience_m.at(i)) standing.arrived_within.at(i) += share;
      }
    }
  }
}

Standing StandingOf(BenchRun run, const ScoredCells& cells, const ScoredCells& baseline) {
  Standing standing;
  standing.run = std::move(run);
  const std::vector<double> scores = Scores(cells, &ScoredDrive::arrived);
  const MeanDifference against =
      statistics::PairedMeans(Less(scores, Scores(baseline, &ScoredDrive::arrived)));
  const auto within = [](Estimated of, double least) {
    of.interval = {std::max(of.interval.low, least), std::min(of.interval.high, 1.0)};
    return of;
  };
  standing.score = within(Estimate(scores), 0.0);
  standing.difference = within(Estimate(against), -1.0);
  standing.verdict = VerdictOf(against);
  standing.told = kToldErrors * against.standard_error;
  standing.unsafe = MeanOf(Scores(cells, &ScoredDrive::unsafe));
  standing.unsafe_difference =
      Estimate(Less(Scores(cells, &ScoredDrive::unsafe), Scores(baseline, &ScoredDrive::unsafe)));
  standing.passes_gate = !(standing.unsafe_difference.interval.low > kTieMargin);
  standing.scraped = MeanOf(Scores(cells, &ScoredDrive::scraped));
  standing.declared = MeanOf(Scores(cells, &ScoredDrive::declared));
  standing.way_ratio = RatioOf(cells, baseline, &ScoredDrive::way_m);
  standing.time_ratio = RatioOf(cells, baseline, &ScoredDrive::time_s);
  standing.energy_ratio = RatioOf(cells, baseline, &ScoredDrive::energy_wh);
  standing.regret = RegretOf(cells);
  SetEnds(standing, cells);
  standing.groups = PartsOf(cells, baseline, true);
  standing.cells = PartsOf(cells, baseline, false);
  standing.drives = cells;
  return standing;
}

// Sets the ranks that are possible where all pairs of entries are compared at once, and which of
// them are told apart.
void SetRanks(std::vector<Standing>& entries, const std::vector<std::vector<double>>& scores) {
  const auto count = static_cast<int>(entries.size());
  const double pairs = count * (count - 1) / 2.0;
  const double confidence = 1.0 - kAlpha / std::max(1.0, pairs);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].worst_rank = count;
    for (std::size_t j = 0; j < entries.size(); ++j) {
      if (i == j) continue;
      const Estimated difference =
          Estimate(statistics::PairedMeans(Less(scores[i], scores[j])), confidence);
      if (difference.interval.high < 0.0) ++entries[i].best_rank;
      if (difference.interval.low > 0.0) --entries[i].worst_rank;
      if (difference.interval.high >= 0.0 && difference.interval.low <= 0.0) {
        entries[i].not_told_from.insert(entries[j].run.name());
      }
    }
  }
}

void RequireAlike(const BenchRun& run, const BenchRun& first) {
  const auto require = [&](const char* what, const auto& own, const auto& other) {
    if (own == other) return;
    throw core::UserError(run.folder.string(),
                          fmt::format("has another {} than {}: {}, and there {}", what,
                                      first.folder.string(), own, other),
                          "put entries of one suite, seed, number of layouts and class into "
                          "one table");
  };
  const auto suite = [](const BenchRun& of) {
    return fmt::format("{} ({:.8})", of.suite, of.suite_digest);
  };
  const auto name = []<typename Choice>(Choice choice) {
    return core::EnumNames<Choice>::kNames.at(static_cast<std::size_t>(choice));
  };
  if (run.suite_digest != first.suite_digest) require("suite", suite(run), suite(first));
  require("seed", run.seed, first.seed);
  require("number of layouts", run.layouts, first.layouts);
  require("class of computing", name(run.manifest.computing), name(first.manifest.computing));
}

}  // namespace

Standings MakeStandings(const std::vector<std::filesystem::path>& folders) {
  Standings standings;
  std::vector<ScoredCells> cells;
  OptimisticWays optimist;
  for (const std::filesystem::path& folder : folders) {
    BenchRun run = ReadBenchRun(folder);
    if (standings.entries.empty()) {
      standings.suite = run.suite;
      standings.layouts = run.layouts;
      standings.baseline = run.name();
    } else {
      RequireAlike(run, standings.entries.front().run);
    }
    const auto same = [&](const Standing& other) { return other.run.name() == run.name(); };
    if (std::ranges::any_of(standings.entries, same)) {
      throw core::UserError(folder.string(), "has the name of another entry: " + run.name(),
                            "give entries names of their own");
    }
    const batch::ResultStore store = batch::ResultStore::Read(folder);
    cells.push_back(ReadScoredCells(run, store));
    if (cells.size() == 1) {
      optimist = MakeOptimisticWays(store);
      standings.why_no_regret = optimist.why_none;
    }
    SetRegrets(cells.back(), optimist);
    standings.entries.push_back(StandingOf(std::move(run), cells.back(), cells.front()));
  }
  std::vector<std::vector<double>> scores;
  scores.reserve(cells.size());
  for (const ScoredCells& of : cells) scores.push_back(Scores(of, &ScoredDrive::arrived));
  SetRanks(standings.entries, scores);
  std::ranges::stable_sort(standings.entries, [](const Standing& a, const Standing& b) {
    return a.score.value > b.score.value;
  });
  return standings;
}

}  // namespace rockyard::campaign
