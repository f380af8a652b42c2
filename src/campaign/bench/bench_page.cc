#include "campaign/bench/bench_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "core/json_text.h"
#include "report/result_table.h"
#include "truth/record.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using report::ObjectTree;

JsonValue TreeOf(const Estimated& of) {
  return ObjectTree("value", of.value, "low", of.interval.low, "high", of.interval.high);
}

JsonValue TreeOf(const Regret& of) {
  JsonValue tree = TreeOf(of.mean);
  tree.Set("drives", JsonValue(of.drives));
  return tree;
}

JsonValue TreeOf(const std::vector<ScoredPart>& parts) {
  return core::ListOf(parts, [](const ScoredPart& part) {
    return ObjectTree("name", part.name, "arrived", part.arrived, "regret", TreeOf(part.regret));
  });
}

// Returns the cells with layouts in which one of two alone arrives.
JsonValue SplitsOf(const Standing& entry, const Standing& baseline) {
  JsonValue::List splits;
  for (std::size_t c = 0; c < entry.drives.size(); ++c) {
    const ScoredCell& cell = entry.drives[c];
    JsonValue::List own;
    JsonValue::List others;
    for (std::size_t i = 0; i < cell.drives.size(); ++i) {
      const bool arrived = cell.drives[i].arrived;
      if (arrived == baseline.drives.at(c).drives.at(i).arrived) continue;
      (arrived ? own : others).emplace_back(static_cast<std::int64_t>(i));
    }
    if (own.empty() && others.empty()) continue;
    const std::string command =
        fmt::format("rockyard replay {} --cell {} --trial {{trial}} --with {}",
                    ShellPath(entry.run.folder.string()), ShellWord(cell.name),
                    ShellPath(baseline.run.folder.string()));
    splits.push_back(ObjectTree("cell", cell.name, "entry", JsonValue(std::move(own)), "baseline",
                                JsonValue(std::move(others)), "command", command));
  }
  return JsonValue(std::move(splits));
}

JsonValue TreeOf(const Standing& of, const Standing& baseline) {
  JsonValue ends = JsonValue::Object();
  for (std::size_t i = 0; i < of.ends.size(); ++i) {
    ends.Set(truth::kTrialOutcomeNames.at(i), JsonValue(of.ends.at(i)));
  }
  const EntryParams& manifest = of.run.manifest;
  return ObjectTree(
      "name", of.run.name(), "folder", of.run.folder.string(), "navigator", manifest.navigator,
      "about", manifest.about, "authors", manifest.authors, "entry_digest", of.run.entry_digest,
      "head", of.run.head, "score", TreeOf(of.score), "difference", TreeOf(of.difference),
      "verdict",
      std::string(core::EnumNames<Verdict>::kNames.at(static_cast<std::size_t>(of.verdict))),
      "best_rank", std::int64_t{of.best_rank}, "worst_rank", std::int64_t{of.worst_rank},
      "not_told_from", core::ListOf(of.not_told_from), "declared", of.declared, "unsafe", of.unsafe,
      "passes_gate", of.passes_gate, "scraped", of.scraped, "regret", TreeOf(of.regret),
      "way_ratio", of.way_ratio, "time_ratio", of.time_ratio, "energy_ratio", of.energy_ratio,
      "ends", std::move(ends), "within", core::ListOf(of.arrived_within), "groups",
      TreeOf(of.groups), "cells", TreeOf(of.cells), "splits", SplitsOf(of, baseline));
}

std::string TitleOf(const Standings& standings) {
  return fmt::format("Benchmark {}: {} entries", standings.suite, standings.entries.size());
}

}  // namespace

std::string BenchPageJson(const Standings& standings, std::string_view command) {
  const Standing& baseline = *std::ranges::find_if(
      standings.entries, [&](const Standing& of) { return of.run.name() == standings.baseline; });
  return core::CompactJson(ObjectTree(
      "title", TitleOf(standings), "suite", standings.suite, "layouts", standings.layouts, "seed",
      std::to_string(baseline.run.seed), "beacon", baseline.run.beacon, "build", BuildName(),
      "command", std::string(command), "baseline", standings.baseline, "why_no_regret",
      standings.why_no_regret, "patience_m", core::ListOf(kPatience_m), "entries",
      core::ListOf(standings.entries, [&](const Standing& of) { return TreeOf(of, baseline); })));
}

std::string BenchPage(const Standings& standings, std::string_view command) {
  return web::MakePage(web::Page::kBench, TitleOf(standings), BenchPageJson(standings, command));
}

}  // namespace rockyard::campaign
