// The designs of sweeps: which levels of the axes make cells (sweep_spec.h).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "core/space_filling.h"
#include "core/text.h"
#include "math/functions.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {
namespace {

using Cells = std::vector<std::vector<LevelSpec>>;

// Must stay: six digits. Names of cells hold them, and seeds are made of names, so that another
// rounding is other trials.
double Rounded(double value) {
  const std::string text = fmt::format("{:.6g}", value);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

Cells Grid(const SweepSpec& spec) {
  Cells cells{{}};
  for (const AxisSpec& axis : spec.axes) {
    Cells longer;
    longer.reserve(cells.size() * axis.levels.size());
    for (const std::vector<LevelSpec>& cell : cells) {
      for (const LevelSpec& level : axis.levels) {
        longer.push_back(cell);
        longer.back().push_back(level);
      }
    }
    cells = std::move(longer);
  }
  return cells;
}

Cells Points(const SweepSpec& spec) {
  const auto points = static_cast<std::size_t>(spec.params.design.points);
  const auto seed = static_cast<std::uint64_t>(spec.params.seed);
  const core::UnitPoints shares = spec.params.design.kind == DesignKind::kSobol
                                      ? core::SobolPoints(points, spec.axes.size(), seed)
                                      : core::LatinHypercube(points, spec.axes.size(), seed);
  Cells cells(points);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t a = 0; a < spec.axes.size(); ++a) {
      cells[i].push_back(spec.axes[a].At(shares[i][a]));
    }
  }
  return cells;
}

Cells Listed(const SweepSpec& spec) {
  Cells cells;
  for (const LevelSpec& cell : spec.cells) cells.push_back({cell});
  return cells;
}

// Refuses too many cells before they are made: a grid grows by the product of its axes.
void RefuseTooMany(const SweepSpec& spec) {
  double cells = 1.0;
  for (const AxisSpec& axis : spec.axes) cells *= static_cast<double>(axis.levels.size());
  if (spec.params.design.kind == DesignKind::kList) cells = static_cast<double>(spec.cells.size());
  if (cells <= static_cast<double>(kMaxSweepCells)) return;
  throw core::UserError("axes",
                        fmt::format("make {:.0f} cells, more than {}", cells, kMaxSweepCells),
                        "use fewer levels, or design sobol with \"points\"");
}

// Checks that axes have different names, by which tables and names of cells tell them apart, and
// that a grid has levels.
void CheckAxes(const SweepSpec& spec, std::vector<core::Problem>& problems) {
  const bool grid = spec.params.design.kind == DesignKind::kGrid;
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    const AxisSpec& axis = spec.axes[i];
    const std::string path = fmt::format("axes[{}]", i);
    if (grid && axis.continuous()) {
      problems.push_back({path, "is a range without steps, which a grid cannot have",
                          "add \"steps\", or use design latin_hypercube or sobol"});
    }
    const auto same = [&](const AxisSpec& other) { return other.axis.name == axis.axis.name; };
    if (std::any_of(spec.axes.begin(), spec.axes.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      problems.push_back({path + ".name",
                          fmt::format("is \"{}\", as another axis is called", axis.axis.name),
                          "give each axis a name of its own"});
    }
  }
}

// Refuses a scale log that was asked for where a number has no logarithm; a scale that nobody asked
// for gives way to the numbers.
void CheckFitScale(const SweepSpec& spec, std::vector<core::Problem>& problems) {
  const core::JsonValue* fit = spec.document.Find("fit");
  const bool asked = fit != nullptr && fit->Find("scale") != nullptr;
  if (!asked || spec.params.fit.scale != AxisScale::kLog) return;
  const std::string& name = spec.params.fit.axis;
  const auto axis = std::find_if(spec.axes.begin(), spec.axes.end(), [&](const AxisSpec& each) {
    return each.axis.numeric && (name.empty() || each.axis.name == name);
  });
  if (axis == spec.axes.end()) return;
  double least = axis->continuous() ? std::min(axis->from, axis->to) : 1.0;
  for (const LevelSpec& level : axis->levels) least = std::min(least, level.number.value_or(1.0));
  if (least > 0.0) return;
  problems.push_back({"fit.scale",
                      fmt::format("is log, and axis {} has the number {}, which has no logarithm",
                                  axis->axis.name, least),
                      "use scale linear, or leave that number out"});
}

void CheckFit(const SweepSpec& spec, std::vector<core::Problem>& problems) {
  CheckFitScale(spec, problems);
  const std::string& name = spec.params.fit.axis;
  if (name.empty()) return;
  std::vector<std::string_view> numeric;
  for (const AxisSpec& axis : spec.axes) {
    if (axis.axis.numeric) numeric.push_back(axis.axis.name);
  }
  if (std::find(numeric.begin(), numeric.end(), name) != numeric.end()) return;
  problems.push_back({"fit.axis", fmt::format("is {}, which is no axis of numbers", name),
                      core::Suggest(name, numeric)});
}

}  // namespace

void CheckDesign(const SweepSpec& spec, std::vector<core::Problem>& problems) {
  const bool list = spec.params.design.kind == DesignKind::kList;
  if (list && spec.cells.empty()) {
    problems.push_back({"cells", "is missing, which design list needs",
                        "write [{\"name\": ..., \"set\": {...}}]"});
  }
  if (!list && spec.axes.empty()) {
    problems.push_back({"axes", "is missing", "name at least one axis, or use design list"});
  }
  if (list != spec.axes.empty() || list == spec.cells.empty()) {
    const std::string_view wrong = list ? "axes" : "cells";
    if (spec.document.Find(wrong) != nullptr) {
      problems.push_back(
          {std::string(wrong),
           fmt::format("has no meaning in design {}", list ? "list" : "other than list"),
           "remove it, or change design.kind"});
    }
  }
  if (spec.axes.size() > core::kMaxDesignDimensions) {
    problems.push_back({"axes", fmt::format("has {} axes", spec.axes.size()),
                        fmt::format("use at most {}", core::kMaxDesignDimensions)});
  }
  CheckAxes(spec, problems);
  CheckFit(spec, problems);
}

LevelSpec AxisSpec::At(double share) const {
  if (!continuous()) {
    const auto index = static_cast<std::size_t>(share * static_cast<double>(levels.size()));
    return levels[std::min(index, levels.size() - 1)];
  }
  double value = axis.scale == AxisScale::kLog ? from * math::Pow(to / from, share)
                                               : from + (to - from) * share;
  value = whole ? std::round(value) : Rounded(value);
  LevelSpec level;
  level.number = value;
  level.text = fmt::format("{}", value);
  level.settings.Set(path, core::JsonValue(value));
  return level;
}

std::vector<std::vector<LevelSpec>> DesignCells(const SweepSpec& spec) {
  switch (spec.params.design.kind) {
    case DesignKind::kGrid:
      RefuseTooMany(spec);
      return Grid(spec);
    case DesignKind::kList:
      RefuseTooMany(spec);
      return Listed(spec);
    case DesignKind::kLatinHypercube:
    case DesignKind::kSobol:
      return Points(spec);
  }
  return {};
}

}  // namespace rockyard::scenario
