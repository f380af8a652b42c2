#include "report/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace rockyard::report {
namespace {

using scenario::Sweep;
using statistics::Combination;
using statistics::FactorialFailures;

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

}  // namespace rockyard::report
