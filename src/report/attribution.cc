#include "report/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "report/line_text.h"
#include "report/result_table.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using scenario::Sweep;
using statistics::Attribution;
using statistics::Combination;
using statistics::Estimate;
using statistics::FactorialFailures;
using statistics::NameOf;

// Cells of one setting of the other axes, by combination.
struct Setting {
  std::string at;
  std::vector<std::size_t> cells;
};

std::vector<std::size_t> AblationAxes(const Sweep& sweep) {
  std::vector<std::size_t> axes;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    if (!sweep.axes[i].ablation.empty()) axes.push_back(i);
  }
  return axes;
}

// The levels of an axis of ablations are "off" and "on" (scenario/sweep_axes.cc), and a grid has
// every combination of them.
Combination CombinationOf(const scenario::SweepCell& cell, std::span<const std::size_t> axes) {
  Combination combination = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (cell.levels[axes[i]].text == "on") combination |= Combination{1} << i;
  }
  return combination;
}

std::string OtherLevels(const Sweep& sweep, const scenario::SweepCell& cell) {
  std::string text;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    if (!sweep.axes[i].ablation.empty()) continue;
    text +=
        fmt::format("{}{}={}", text.empty() ? "" : ",", sweep.axes[i].name, cell.levels[i].text);
  }
  return text;
}

std::vector<Setting> Settings(const Sweep& sweep, std::span<const std::size_t> axes) {
  std::vector<Setting> settings;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const scenario::SweepCell& cell = sweep.cells[i];
    const std::string at = OtherLevels(sweep, cell);
    const auto [found, fresh] = known.try_emplace(at, settings.size());
    if (fresh) settings.push_back({at, std::vector<std::size_t>(std::size_t{1} << axes.size())});
    settings[found->second].cells[CombinationOf(cell, axes)] = i;
  }
  return settings;
}

SweepAttribution AttributeSetting(const Setting& setting, const std::vector<std::string>& functions,
                                  std::span<const CellOutcomes> outcomes) {
  SweepAttribution result{.at = setting.at, .by_success = {}};
  std::size_t trials = outcomes[setting.cells.front()].size();
  std::size_t per_layout = 1;
  for (const std::size_t cell : setting.cells) {
    trials = std::min(trials, outcomes[cell].size());
    per_layout = std::lcm(per_layout, outcomes[cell].per_layout());
  }
  std::array<FactorialFailures, 2> failures;
  for (FactorialFailures& each : failures) {
    each.functions = functions;
    each.failed.resize(setting.cells.size());
  }
  for (std::size_t t = 0; t < trials; ++t) {
    if (std::any_of(setting.cells.begin(), setting.cells.end(),
                    [&](std::size_t cell) { return outcomes[cell].IsFault(t); })) {
      ++result.left_out;
      continue;
    }
    for (std::size_t kind = 0; kind < failures.size(); ++kind) {
      if (per_layout > 1) failures[kind].clusters.push_back(t / per_layout);
      for (std::size_t c = 0; c < setting.cells.size(); ++c) {
        const CellOutcomes& cell = outcomes[setting.cells[c]];
        failures[kind].failed[c].push_back(cell.Succeeded(t, static_cast<SuccessKind>(kind)) ? 0
                                                                                             : 1);
      }
    }
  }
  for (std::size_t kind = 0; kind < failures.size(); ++kind) {
    result.by_success[kind] = statistics::Attribute(failures[kind]);
  }
  return result;
}

constexpr std::size_t kNameWidth = 23;  // three intervals beside it fit 100 columns
constexpr std::size_t kPlaceWidth = 30;
// Longer tables are for files.
constexpr std::size_t kMaxEffects = 15;

std::string Percent(const Estimate& estimate) {
  return fmt::format("{:6.1f} ({:6.1f} ..{:6.1f})", 100.0 * estimate.value,
                     100.0 * estimate.interval.low, 100.0 * estimate.interval.high);
}

std::string Percent(const statistics::Proportion& rate) {
  return Percent(Estimate{rate.rate, rate.interval});
}

std::string Shares(const Attribution& result) {
  std::string text = fmt::format("  {:<{}} {:<24} {:<24} {}\n", "made perfect removes, %",
                                 kNameWidth, "Shapley share", "alone", "after all others");
  for (const statistics::FunctionShare& row : result.shares) {
    text += fmt::format("  {:<{}} {} {} {}\n", Cut(row.function, kNameWidth), kNameWidth,
                        Percent(row.share), Percent(row.first), Percent(row.last));
  }
  text += fmt::format("  {:<{}} {} {:6.1f}: these need not sum\n", "all of them", kNameWidth,
                      Percent(result.removed), 100.0 * result.sum_of_firsts);
  return text;
}

std::string Failures(const Attribution& result) {
  return fmt::format("  {:<{}} {}\n  {:<{}} {}\n", "fail as flown, %", kNameWidth,
                     Percent(result.failures.front()), "fail, all perfect, %", kNameWidth,
                     Percent(result.remainder));
}

std::string Effects(const Attribution& result) {
  std::string text =
      "  effects on the failure probability, points of per cent (interactions: halved "
      "differences)\n";
  for (std::size_t i = 0; i < result.effects.size() && i < kMaxEffects; ++i) {
    const statistics::EffectOfSet& row = result.effects[i];
    text += fmt::format("    {}  {}\n", Percent(row.effect),
                        statistics::NameOf(row.set, result.functions).substr(0, 70));
  }
  return text;
}

std::string Combinations(const Attribution& result) {
  std::string text = "  failures with these perfect, %\n";
  for (std::size_t c = 0; c < result.failures.size() && c <= kMaxEffects; ++c) {
    const auto set = static_cast<statistics::Combination>(c);
    const std::string name = statistics::NameOf(set, result.functions, " + ");
    text += fmt::format("    {}  {}\n", Percent(result.failures[c]), name.substr(0, 70));
  }
  return text;
}

std::string Table(const SweepAttribution& attribution, std::size_t kind) {
  const Attribution& result = attribution.by_success[kind];
  const std::string at = attribution.at.empty() ? "" : ", " + Cut(attribution.at, kPlaceWidth);
  std::string text = fmt::format("\nattribution of failures, {}{}: {} paired trials\n",
                                 kSuccessNames[kind], at, result.trials);
  if (attribution.left_out > 0) {
    text += fmt::format("  {} with a fault in some cell left out\n", attribution.left_out);
  }
  if (result.trials == 0) return text;
  text += Failures(result) + Shares(result);
  // Declared success gets the short table.
  if (kind == static_cast<std::size_t>(SuccessKind::kDeclared)) return text;
  return text + Effects(result) + Combinations(result);
}

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

std::vector<SweepAttribution> AttributeSweep(const Sweep& sweep,
                                             std::span<const CellOutcomes> outcomes) {
  const std::vector<std::size_t> axes = AblationAxes(sweep);
  if (sweep.design != scenario::DesignKind::kGrid || !sweep.common_random_numbers || axes.empty() ||
      axes.size() > statistics::kMaxFunctions) {
    return {};
  }
  std::vector<std::string> functions;
  functions.reserve(axes.size());
  for (const std::size_t axis : axes) functions.push_back(sweep.axes[axis].name);
  std::vector<SweepAttribution> attributions;
  for (const Setting& setting : Settings(sweep, axes)) {
    attributions.push_back(AttributeSetting(setting, functions, outcomes));
  }
  return attributions;
}

std::string AttributionText(std::span<const SweepAttribution> attributions) {
  std::string text;
  for (const SweepAttribution& attribution : attributions) {
    text += Table(attribution, static_cast<std::size_t>(SuccessKind::kTrue));
    text += Table(attribution, static_cast<std::size_t>(SuccessKind::kDeclared));
  }
  return text;
}

std::string AttributionCsv(std::span<const SweepAttribution> attributions) {
  std::string csv = "at,success,kind,functions,value,low,high\n";
  for (const SweepAttribution& attribution : attributions) {
    for (std::size_t kind = 0; kind < kSuccessNames.size(); ++kind) {
      ForEachRow(
          attribution.by_success[kind],
          [&](std::string_view what, const std::string& functions, const Estimate& estimate) {
            csv += CsvLine(attribution.at, kSuccessNames[kind], what, functions, estimate.value,
                           estimate.interval);
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
        rows.push_back(ObjectTree("kind", what, "functions", functions, "value", estimate.value,
                                  "interval", estimate.interval));
      });
      list.push_back(ObjectTree("at", attribution.at, "success", kSuccessNames[kind], "trials",
                                result.trials, "left_out", attribution.left_out, "sum_of_alone",
                                result.sum_of_firsts, "rows", std::move(rows)));
    }
  }
  return JsonValue(std::move(list));
}

}  // namespace rockyard::report
