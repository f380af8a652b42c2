#include <functional>
#include <string_view>
#include <utility>

#include "report/attribution.h"
#include "report/csv.h"
#include "report/json_values.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::NumberOrNull;
using statistics::Attribution;
using statistics::Estimate;
using statistics::NameOf;

// Calls row(kind, functions, estimate) for everything that an attribution says.
void ForEachRow(
    const Attribution& result,
    const std::function<void(std::string_view, const std::string&, const Estimate&)>& row) {
  for (std::size_t c = 0; c < result.failures.size(); ++c) {
    const statistics::Proportion& rate = result.failures[c];
    row("failure_rate", NameOf(static_cast<statistics::Combination>(c), result.functions, " + "),
        {rate.rate, rate.interval});
  }
  for (const statistics::FunctionShare& each : result.shares) {
    row("share", each.function, each.share);
    row("alone", each.function, each.first);
    row("last", each.function, each.last);
  }
  row("removed", "all", result.removed);
  row("remainder", "all", {result.remainder.rate, result.remainder.interval});
  for (const statistics::EffectOfSet& each : result.effects) {
    row("effect", NameOf(each.set, result.functions), each.effect);
  }
}

}  // namespace

std::string AttributionCsv(std::span<const SweepAttribution> attributions) {
  std::string csv = "at,success,kind,functions,value,low,high\n";
  for (const SweepAttribution& attribution : attributions) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      ForEachRow(
          attribution.by_success[kind],
          [&](std::string_view what, const std::string& functions, const Estimate& estimate) {
            const std::vector<std::string> fields{CsvField(attribution.at),
                                                  std::string(kSuccessNames[kind]),
                                                  std::string(what),
                                                  CsvField(functions),
                                                  CsvNumber(estimate.value),
                                                  CsvNumber(estimate.interval.low),
                                                  CsvNumber(estimate.interval.high)};
            csv += CsvLine(fields);
          });
    }
  }
  return csv;
}

JsonValue AttributionJson(std::span<const SweepAttribution> attributions) {
  JsonValue::List list;
  for (const SweepAttribution& attribution : attributions) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      const Attribution& result = attribution.by_success[kind];
      JsonValue::List rows;
      ForEachRow(result, [&](std::string_view what, const std::string& functions,
                             const Estimate& estimate) {
        rows.push_back(JsonValue::Object({{"kind", what},
                                          {"functions", functions},
                                          {"value", NumberOrNull(estimate.value)},
                                          {"interval", EndsOf(estimate.interval)}}));
      });
      JsonValue& json = list.emplace_back(
          JsonValue::Object({{"at", attribution.at},
                             {"success", kSuccessNames[kind]},
                             {"trials", result.trials},
                             {"left_out", attribution.left_out},
                             {"sum_of_alone", NumberOrNull(result.sum_of_firsts)}}));
      json.Set("rows", JsonValue(std::move(rows)));
    }
  }
  return JsonValue(std::move(list));
}

}  // namespace rockyard::report
