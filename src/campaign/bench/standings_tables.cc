// The standings as tables.
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "campaign/bench/bench_standings.h"

namespace rockyard::campaign {
namespace {

std::string_view NameOf(Verdict verdict) {
  return core::EnumNames<Verdict>::kNames.at(static_cast<std::size_t>(verdict));
}

// A share in percent, with its interval where there is one.
std::string Percent(const Estimated& of) {
  if (!std::isfinite(of.value)) return "";
  if (!std::isfinite(of.interval.high)) return fmt::format("{:.1f}", 100.0 * of.value);
  return fmt::format("{:.1f} ({:.1f} .. {:.1f})", 100.0 * of.value, 100.0 * of.interval.low,
                     100.0 * of.interval.high);
}

}  // namespace

report::ResultTable Standings::Table() const {
  report::ResultTable table(
      "entry,score,score_low,score_high,difference,difference_low,difference_high,verdict,told,"
      "best_rank,worst_rank,declared,unsafe,passes_gate,scraped,way_ratio,time_ratio,energy_ratio,"
      "regret,regret_low,regret_high,regret_drives,entry_digest,head");
  for (const Standing& of : entries) {
    table.Add(of.run.name(), of.score.value, of.score.interval, of.difference.value,
              of.difference.interval, NameOf(of.verdict), of.told, of.best_rank, of.worst_rank,
              of.declared, of.unsafe, of.passes_gate, of.scraped, of.way_ratio, of.time_ratio,
              of.energy_ratio, of.regret.mean.value, of.regret.mean.interval, of.regret.drives,
              of.run.entry_digest, of.run.head);
  }
  return table;
}

namespace {

report::ResultTable PartsTable(const std::vector<Standing>& entries, const char* part,
                               std::vector<ScoredPart> Standing::*parts) {
  report::ResultTable table(
      fmt::format("entry,{},arrived,baseline,difference,difference_low,difference_high,regret,"
                  "regret_low,regret_high,regret_drives",
                  part));
  for (const Standing& of : entries) {
    for (const ScoredPart& in : of.*parts) {
      table.Add(of.run.name(), in.name, in.arrived, in.baseline, in.difference.value,
                in.difference.interval, in.regret.mean.value, in.regret.mean.interval,
                in.regret.drives);
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
  // No number where no drive arrives in both.
  const auto ratio = [](double of) { return std::isnan(of) ? "" : fmt::format("{:.2f}", of); };
  std::string text = fmt::format(
      "| entry | arrived [%] | to {} [points] | | ranks | declared [%] | unsafe [%] | scraped [%] "
      "| regret [%] | way | time | energy | tells [points] "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      baseline);
  for (const Standing& of : entries) {
    const bool base = of.run.name() == baseline;
    text += fmt::format(
        "| {}{} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", of.run.name(),
        of.passes_gate ? "" : " (not safe enough)", Percent(of.score),
        base ? "" : Percent(of.difference), base ? "baseline" : NameOf(of.verdict),
        of.best_rank == of.worst_rank ? fmt::format("{}", of.best_rank)
                                      : fmt::format("{} to {}", of.best_rank, of.worst_rank),
        percent(of.declared), percent(of.unsafe), percent(of.scraped), Percent(of.regret.mean),
        ratio(of.way_ratio), ratio(of.time_ratio), ratio(of.energy_ratio),
        base ? "" : percent(of.told));
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
