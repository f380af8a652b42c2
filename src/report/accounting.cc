#include "report/accounting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "report/line_text.h"

namespace rockyard::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kShardNote =
    "a shard tells no rates: put all shards together with rockyard merge";

Json Stopping(const StoppingReport& stopping) {
  Json json = {{"rule", "until_half_width"},        {"half_width", stopping.half_width},
               {"max_trials", stopping.max_trials}, {"block", stopping.block},
               {"confidence", stopping.confidence}, {"allocation", stopping.allocation}};
  json["budget"] = stopping.budget > 0 ? Json(stopping.budget) : Json(nullptr);
  json["end"] = stopping.end;
  json["trials"] = stopping.trials;
  json["declared_success"] = {{"count", stopping.successes}, {"trials", stopping.drives}};
  json["confidence_sequence"] = Json::array({stopping.low, stopping.high});
  return json;
}

Json Parts(const Accounting& a, const std::optional<StoppingReport>& stopping) {
  Json json;
  json["accounting"] = {{"planned", a.planned},
                        {"completed", a.completed},
                        {"faulted", a.faulted},
                        {"pending", a.pending},
                        {"infrastructure_faults", a.infrastructure_faults}};
  if (stopping) json["stopping"] = Stopping(*stopping);
  return json;
}

Json Parts(const RunDescription& run) {
  Json json = Parts(run.accounting, run.stopping);
  if (run.shard_count > 1) {
    json["shard"] = {{"index", run.shard_index}, {"count", run.shard_count}};
  }
  return json;
}

std::string Why(const StoppingReport& stopping) {
  if (stopping.end == "precise") return "precise enough";
  if (stopping.end == "max_trials") return "at the most trials, not precise enough";
  if (stopping.end == "budget") return "the budget is used up, not precise enough";
  return "not yet precise enough";
}

std::string StoppingText(const StoppingReport& stopping) {
  return Wrapped(fmt::format(
      "  {} after {} trials: half-width {:.2f} % for {:.2f} % wanted, looked at every {} trials\n"
      "  declared success at that look {} of {}: {:.1f} .. {:.1f} % ({:g} %, valid at any time)\n",
      Why(stopping), stopping.trials, 50.0 * (stopping.high - stopping.low),
      100.0 * stopping.half_width, stopping.block, stopping.successes, stopping.drives,
      100.0 * stopping.low, 100.0 * stopping.high, 100.0 * stopping.confidence));
}

}  // namespace

std::string AccountingJson(const RunDescription& run) { return Parts(run).dump(); }

std::string AccountingJson(const Accounting& accounting,
                           const std::optional<StoppingReport>& stopping) {
  return Parts(accounting, stopping).dump();
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
  return fmt::format("{} after {} trials, {:.1f} .. {:.1f} %", Why(stopping), stopping.trials,
                     100.0 * stopping.low, 100.0 * stopping.high);
}

std::string ShardCampaignJson(const std::string& name, int index, int count,
                              const std::vector<ShardCell>& cells) {
  Accounting total;
  Json parts = Json::array();
  for (const ShardCell& cell : cells) {
    total = Sum(total, cell.accounting);
    Json part = {{"name", cell.name}};
    part.update(Parts(cell.accounting, std::nullopt));
    parts.push_back(part);
  }
  Json json = {{"schema_version", 1}, {"kind", "sweep_shard"}, {"name", name}};
  json.update(Parts(total, std::nullopt));
  json["shard"] = {{"index", index}, {"count", count}};
  json["cells"] = parts;
  json["note"] = kShardNote;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ShardJson(const RunDescription& run) {
  Json json = {{"schema_version", 1},
               {"scenario", run.scenario},
               {"seed", run.seed},
               {"fingerprint", run.fingerprint}};
  json.update(Parts(run));
  json["note"] = kShardNote;
  json["shard_hash"] = run.trial_hash;
  json["builds"] = run.builds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ShardText(const RunDescription& run) {
  return fmt::format("{}, seed {}: shard {} of {}\n", Cut(Printable(run.scenario), 40), run.seed,
                     run.shard_index, run.shard_count) +
         SettingsText(run) + AccountingText(run) +
         "  no rates from a shard: put all of them together\n";
}

}  // namespace rockyard::report
