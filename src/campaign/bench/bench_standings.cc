#include "campaign/bench/bench_standings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "batch/result_store.h"
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

// What counts of one drive.
struct ScoredDrive {
  bool arrived = false;
  bool declared = false;
  bool unsafe = false;
  bool scraped = false;
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
  double no_progress_m = 0.0;
  double way_m = 0.0;
  double time_s = 0.0;
  double energy_wh = 0.0;
};

struct ScoredCell {
  std::string name;
  double weight = 0.0;
  std::vector<ScoredDrive> drives;  // by layout
};

using ScoredCells = std::vector<ScoredCell>;
using Flag = bool ScoredDrive::*;

std::string GroupOf(const std::string& cell) { return cell.substr(0, cell.find('/')); }

std::size_t ColumnOf(const truth::RecordSchema& schema, std::string_view name) {
  const auto found =
      std::ranges::find_if(schema, [&](const truth::ValueInfo& info) { return info.name == name; });
  return static_cast<std::size_t>(found - schema.begin());
}

ScoredCells ReadCells(const BenchRun& run) {
  const batch::ResultStore store = batch::ResultStore::Read(run.folder);
  const truth::RecordSchema& schema = store.identity().schema;
  const std::size_t way = ColumnOf(schema, "true_distance_m");
  const std::size_t time = ColumnOf(schema, "active_time_s");
  const std::size_t energy = ColumnOf(schema, "active_energy_wh");
  const std::size_t scrapes = ColumnOf(schema, "scrapes");
  const std::size_t no_progress = ColumnOf(schema, "no_progress_distance_m");
  ScoredCells cells;
  std::map<std::string, int> sizes;
  for (int i = 0; i < store.cells(); ++i) {
    ScoredCell cell;
    cell.name = store.identity().cells.at(static_cast<std::size_t>(i)).name;
    ++sizes[GroupOf(cell.name)];
    for (const truth::Record& record : store.Load(i)) {
      ScoredDrive drive;
      drive.outcome = record.outcome;
      drive.arrived = TrueSuccess(record.outcome);
      drive.declared = DeclaredSuccess(record.outcome);
      drive.unsafe = record.outcome == truth::TrialOutcome::kTipOver ||
                     record.outcome == truth::TrialOutcome::kHighCentred;
      if (!record.values.empty()) {
        drive.scraped = record.values.at(scrapes) > 0.0;
        drive.no_progress_m = record.values.at(no_progress);
        drive.way_m = record.values.at(way);
        drive.time_s = record.values.at(time);
        drive.energy_wh = record.values.at(energy);
      }
      cell.drives.push_back(drive);
    }
    if (static_cast<std::int64_t>(cell.drives.size()) != run.layouts) {
      throw core::UserError(run.folder.string(), "lacks drives of " + cell.name,
                            "go on with the run: rockyard bench run ... --resume");
    }
    cells.push_back(std::move(cell));
  }
  const auto groups = static_cast<double>(sizes.size());
  for (ScoredCell& cell : cells) cell.weight = 1.0 / (groups * sizes[GroupOf(cell.name)]);
  return cells;
}

// Returns the score of each layout, over the cells of one group or of all ("").
std::vector<double> Scores(const ScoredCells& cells, Flag flag, const std::string& group = "") {
  std::vector<double> scores(cells.front().drives.size(), 0.0);
  double total = 0.0;
  for (const ScoredCell& cell : cells) {
    if (!group.empty() && GroupOf(cell.name) != group) continue;
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
    parts.push_back({name, MeanOf(own), MeanOf(others), Estimate(Less(own, others))});
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
  SetEnds(standing, cells);
  standing.groups = PartsOf(cells, baseline, true);
  standing.cells = PartsOf(cells, baseline, false);
  return standing;
}

// Sets the ranks that are possible where all pairs of entries are compared at once.
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
    }
  }
}

void RequireAlike(const BenchRun& run, const BenchRun& first) {
  const auto require = [&](bool alike, const char* what) {
    if (alike) return;
    throw core::UserError(run.folder.string(),
                          fmt::format("has another {} than {}", what, first.folder.string()),
                          "put entries of one suite, class and seed into one table");
  };
  require(run.suite_digest == first.suite_digest, "suite");
  require(run.seed == first.seed, "seed");
  require(run.layouts == first.layouts, "number of layouts");
  require(run.manifest.computing == first.manifest.computing, "class of computing");
}

std::string_view NameOf(Verdict verdict) {
  return core::EnumNames<Verdict>::kNames.at(static_cast<std::size_t>(verdict));
}

}  // namespace

Standings MakeStandings(const std::vector<std::filesystem::path>& folders) {
  Standings standings;
  std::vector<ScoredCells> cells;
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
    cells.push_back(ReadCells(run));
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

report::ResultTable Standings::Table() const {
  report::ResultTable table(
      "entry,score,score_low,score_high,difference,difference_low,difference_high,verdict,told,"
      "best_rank,worst_rank,declared,unsafe,passes_gate,scraped,way_ratio,time_ratio,energy_ratio,"
      "entry_digest,head");
  for (const Standing& of : entries) {
    table.Add(of.run.name(), of.score.value, of.score.interval, of.difference.value,
              of.difference.interval, NameOf(of.verdict), of.told, of.best_rank, of.worst_rank,
              of.declared, of.unsafe, of.passes_gate, of.scraped, of.way_ratio, of.time_ratio,
              of.energy_ratio, of.run.entry_digest, of.run.head);
  }
  return table;
}

namespace {

report::ResultTable PartsTable(const std::vector<Standing>& entries, const char* part,
                               std::vector<ScoredPart> Standing::*parts) {
  report::ResultTable table(
      fmt::format("entry,{},arrived,baseline,difference,difference_low,difference_high", part));
  for (const Standing& of : entries) {
    for (const ScoredPart& in : of.*parts) {
      table.Add(of.run.name(), in.name, in.arrived, in.baseline, in.difference.value,
                in.difference.interval);
    }
  }
  return table;
}

}  // namespace

report::ResultTable Standings::Groups() const {
  return PartsTable(entries, "group", &Standing::groups);
}

report::ResultTable Standings::Cells() const {
  return PartsTable(entries, "cell", &Standing::cells);
}

report::ResultTable Standings::Ends() const {
  report::ResultTable table("entry,end,share");
  for (const Standing& of : entries) {
    for (std::size_t i = 0; i < of.ends.size(); ++i) {
      table.Add(of.run.name(), truth::kTrialOutcomeNames.at(i), of.ends.at(i));
    }
    for (std::size_t i = 0; i < kPatience_m.size(); ++i) {
      table.Add(of.run.name(), fmt::format("goal_reached_within_{:g}_m", kPatience_m.at(i)),
                of.arrived_within.at(i));
    }
  }
  return table;
}

std::string Standings::Markdown() const {
  const auto percent = [](double share) { return fmt::format("{:.1f}", 100.0 * share); };
  const auto ends = [](const Estimated& of) {
    return fmt::format("{:.1f} ({:.1f} .. {:.1f})", 100.0 * of.value, 100.0 * of.interval.low,
                       100.0 * of.interval.high);
  };
  std::string text = fmt::format(
      "| entry | arrived [%] | to {} [points] | | ranks | declared [%] | unsafe [%] | scraped [%] "
      "| way | time | energy | tells [points] "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      baseline);
  for (const Standing& of : entries) {
    const bool base = of.run.name() == baseline;
    text += fmt::format(
        "| {}{} | {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {} |\n",
        of.run.name(), of.passes_gate ? "" : " (not safe enough)", ends(of.score),
        base ? "" : ends(of.difference), base ? "baseline" : NameOf(of.verdict),
        of.best_rank == of.worst_rank ? fmt::format("{}", of.best_rank)
                                      : fmt::format("{} to {}", of.best_rank, of.worst_rank),
        percent(of.declared), percent(of.unsafe), percent(of.scraped), of.way_ratio, of.time_ratio,
        of.energy_ratio, base ? "" : percent(of.told));
  }
  text += "\n| arrived [%] |";
  for (const ScoredPart& group : entries.front().groups) text += fmt::format(" {} |", group.name);
  text += "\n|---|";
  for (std::size_t i = 0; i < entries.front().groups.size(); ++i) text += "---|";
  for (const Standing& of : entries) {
    text += fmt::format("\n| {} |", of.run.name());
    for (const ScoredPart& group : of.groups) text += fmt::format(" {} |", percent(group.arrived));
  }
  return text + "\n";
}

}  // namespace rockyard::campaign
