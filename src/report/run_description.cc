#include "report/run_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "core/json_text.h"
#include "report/line_text.h"
#include "report/result_table.h"
#include "report/summary_json.h"

namespace rockyard::report {
namespace {

using core::JsonValue;

constexpr const char* kShardNote =
    "a shard tells no rates: put all shards together with rockyard merge";

JsonValue Stopping(const StoppingReport& stopping) {
  return ObjectTree("rule", "until_half_width", "half_width", stopping.half_width, "max_trials",
                    stopping.max_trials, "block", stopping.block, "confidence", stopping.confidence,
                    "allocation", stopping.allocation, "budget",
                    stopping.budget > 0 ? JsonValue(stopping.budget) : JsonValue(), "end",
                    stopping.end, "trials", stopping.trials, "declared_success",
                    ObjectTree("count", stopping.successes, "trials", stopping.drives), "interval",
                    statistics::Interval{stopping.low, stopping.high});
}

JsonValue Counts(const Accounting& a) {
  return ObjectTree("planned", a.planned, "completed", a.completed, "faulted", a.faulted, "pending",
                    a.pending, "infrastructure_faults", a.infrastructure_faults);
}

JsonValue ShardOf(int index, int count) { return ObjectTree("index", index, "count", count); }

std::string Why(const StoppingReport& stopping) {
  if (stopping.end == "precise") return "precise enough";
  if (stopping.end == "max_trials") return "at the most trials, not precise enough";
  if (stopping.end == "budget") return "the budget is used up, not precise enough";
  return "not yet precise enough";
}

std::string StoppingText(const StoppingReport& stopping) {
  return Wrapped(
      fmt::format("  {}, looked at every {} trials; intervals of rates allow for this rule\n",
                  StoppingPhrase(stopping), stopping.block));
}

}  // namespace

JsonValue AccountingJson(const RunDescription& run) {
  JsonValue json = AccountingJson(run.accounting, run.stopping);
  if (run.shard_count > 1) json.Set("shard", ShardOf(run.shard_index, run.shard_count));
  return json;
}

JsonValue AccountingJson(const Accounting& accounting,
                         const std::optional<StoppingReport>& stopping) {
  JsonValue json = ObjectTree("accounting", Counts(accounting));
  if (stopping) json.Set("stopping", Stopping(*stopping));
  return json;
}

std::string AccountingText(const Accounting& a) {
  std::string text = fmt::format("  {} planned = {} completed + {} faulted + {} pending\n",
                                 a.planned, a.completed, a.faulted, a.pending);
  if (a.infrastructure_faults > 0) {
    text +=
        fmt::format("  {} failures of the machine, retried: no results\n", a.infrastructure_faults);
  }
  return text;
}

std::string SettingsText(const RunDescription& run) {
  if (!run.settings || run.settings->empty()) return "";
  constexpr std::size_t kWidth = 100;
  const std::string settings = fmt::format("{}", fmt::join(*run.settings, ", "));
  return fmt::format("  with {}\n", Cut(Printable(settings), kWidth - 7));
}

std::string AccountingText(const RunDescription& run) {
  const std::string text = AccountingText(run.accounting);
  return run.stopping ? text + StoppingText(*run.stopping) : text;
}

Accounting Sum(const Accounting& first, const Accounting& second) {
  return {.planned = first.planned + second.planned,
          .completed = first.completed + second.completed,
          .faulted = first.faulted + second.faulted,
          .pending = first.pending + second.pending,
          .infrastructure_faults = first.infrastructure_faults + second.infrastructure_faults};
}

std::string StoppingPhrase(const StoppingReport& stopping) {
  return fmt::format("{} after {} trials: half-width {:.2f} % for {:.2f} % wanted", Why(stopping),
                     stopping.trials, 50.0 * (stopping.high - stopping.low),
                     100.0 * stopping.half_width);
}

std::string ShardCampaignJson(const std::string& name, int index, int count,
                              const std::vector<ShardCell>& cells) {
  Accounting total;
  JsonValue::List parts;
  for (const ShardCell& cell : cells) {
    total = Sum(total, cell.accounting);
    JsonValue part = ObjectTree("name", cell.name);
    part.Update(AccountingJson(cell.accounting, std::nullopt));
    parts.push_back(std::move(part));
  }
  JsonValue json =
      ObjectTree("schema_version", kSchemaVersion, "kind", "sweep_shard", "name", name);
  json.Update(AccountingJson(total, std::nullopt));
  SetMembers(json, "shard", ShardOf(index, count), "cells", std::move(parts), "note", kShardNote);
  return core::SpreadJson(json) + "\n";
}

std::string ShardJson(const RunDescription& run) {
  JsonValue json = ObjectTree("schema_version", kSchemaVersion, "scenario", run.scenario, "seed",
                              run.seed, "fingerprint", run.fingerprint);
  json.Update(AccountingJson(run));
  SetMembers(json, "note", kShardNote, "shard_hash", run.trial_hash, "builds",
             core::ListOf(run.builds));
  return core::SpreadJson(json) + "\n";
}

std::string ShardText(const RunDescription& run) {
  return fmt::format("{}, seed {}: shard {} of {}\n", Cut(Printable(run.scenario), 40), run.seed,
                     run.shard_index, run.shard_count) +
         SettingsText(run) + AccountingText(run) +
         "  no rates from a shard: put all of them together\n";
}

}  // namespace rockyard::report
