// What a sweep file says, before any cell is made. LoadSweep reads it, checks it and makes the
// cells of it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/json_value.h"
#include "scenario/scenario.h"
#include "scenario/sweep_keys.h"

namespace rockyard::scenario {

// One value of an axis, or one listed cell: what it changes of the scenario.
struct LevelSpec {
  std::string text;
  std::optional<double> number = {};
  core::JsonValue settings = core::JsonValue::Object();  // dotted path -> value
  std::shared_ptr<const core::JsonValue> scenario = {};  // takes the place of the base
  std::string ablation = {};                             // applied after all settings
};

struct AxisSpec {
  SweepAxis axis;
  std::string path;    // of a parameter; empty where levels set several
  bool whole = false;  // the parameter takes integers only
  double from = 0.0;   // range of an axis without levels
  double to = 0.0;
  std::vector<LevelSpec> levels;

  bool continuous() const { return levels.empty(); }
  // Returns the level at a share of the range from 0 to 1, rounded to six significant digits, so
  // that names stay short. Of an axis with levels it is the level whose slice holds the share.
  LevelSpec At(double share) const;
};

struct SweepSpec {
  SweepParams params;
  core::JsonValue document;  // with every file that is named
  std::shared_ptr<const core::JsonValue> scenario;
  Scenario defaults;    // with the plugins of `scenario` and `settings`
  bool sealed = false;  // plugins are not opened
  core::JsonValue settings = core::JsonValue::Object();  // "set" of the file
  std::vector<AxisSpec> axes;
  std::vector<LevelSpec> cells;  // of design list
};

// Reads the document of a sweep file, whose cells have the values of `changes.defaults` where they
// state no others, and whose "extends" are resolved. Adds what is wrong to
// `problems`; the result is of use only where nothing was added.
SweepSpec ReadSweepSpec(core::JsonValue document, const std::filesystem::path& folder,
                        const SweepChanges& changes, std::vector<core::Problem>& problems);

// Checks that design, axes, cells and fit fit together; adds what is wrong to `problems`.
void CheckDesign(const SweepSpec& spec, std::vector<core::Problem>& problems);

// Returns which levels each cell has, one per axis, in the order of the design: a grid with its
// last axis fastest. Must stay: that order, as stores know cells by number, and the points that
// core/space_filling.h draws, as each is a cell. Throws core::UserError where there are more than
// kMaxSweepCells.
std::vector<std::vector<LevelSpec>> DesignCells(const SweepSpec& spec);

}  // namespace rockyard::scenario
