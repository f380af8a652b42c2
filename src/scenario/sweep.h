// Sweep files: one base scenario, axes along which it is varied, and a design that says which
// combinations are run. Every combination is a cell: a scenario of its own. The command `sweep`
// runs the cells, `validate` and `list` read the files, and reports draw results along the axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"
#include "scenario/scenario.h"

namespace rockyard::scenario {

enum class DesignKind {
  kGrid,            // every combination of every level
  kList,            // the cells that the file lists
  kLatinHypercube,  // points that cover every axis evenly
  kSobol,           // likewise, and more points go on with the same sequence
};

enum class AxisScale { kLinear, kLog };

// One axis of a sweep, as tables and drawings need it.
struct SweepAxis {
  std::string name;  // the last part of the path, or what the file calls it
  std::string unit = "1";
  bool numeric = false;
  AxisScale scale = AxisScale::kLinear;
  std::string ablation = {};  // applied by its second level; empty for any other axis
};

// Where a cell stands on an axis.
struct SweepLevel {
  std::string text;              // the number or the name of the level
  std::optional<double> number;  // of numeric axes
};

struct SweepCell {
  std::string name;                // unique: "k_per_m2=0.01,navigator=gestalt"
  std::vector<SweepLevel> levels;  // one per axis
  Scenario scenario;               // with the name, the trials and the seed of the cell
};

struct Sweep {
  std::string name;
  std::string description;
  std::string document;  // JSON text of the file with all that it extends, and with the overrides
  DesignKind design = DesignKind::kGrid;
  std::uint64_t seed = 1;
  bool common_random_numbers = false;
  std::vector<SweepAxis> axes;
  std::vector<SweepCell> cells;
  std::optional<std::size_t> fit_axis;  // whose numbers success is fitted against
  AxisScale fit_scale = AxisScale::kLog;
};

// What the command line changes of a sweep.
struct SweepChanges {
  // "PATH=VALUE" on every cell's scenario. Those before a list of plugins are what that list
  // chooses for want of better: they give way to axes, cells and settings of the file.
  std::vector<std::string> overrides = {};
  std::optional<std::int64_t> trials = {};
  std::optional<std::int64_t> seed = {};
  Scenario defaults = {};  // of every cell, with the navigators and estimators that it may name
  bool sealed = false;     // plugins are not opened: the cells are to be shown, not run
};

inline constexpr std::size_t kMaxSweepCells = 10'000;

// Returns whether a document is a sweep rather than a scenario.
bool IsSweep(const core::JsonValue& document);

// Reads a sweep file (scenarios/sweeps/README.md describes it) and resolves every cell.
//
// The scenario of a cell is, in this order: the scenario of its level where an axis has scenarios,
// else that of the file; "set" of the file and the overrides; the settings of each axis, in the
// order of the axes; the ablations of axes. A setting that is an object changes the members that it
// names.
//
// The seed of a cell is that of the campaign with common random numbers, so that cells can be
// compared in pairs. Else it is a hash of the campaign's seed and the name of the cell (its axes
// and levels, or what the file calls it), so that cells keep their trials when a design grows.
//
// Must stay: the order of settings, the seeds, and names and places of cells, by which stores,
// baselines and traces know them.
//
// Every value that was asked for is read back from the resolved scenario and must be there.
// Throws core::UserError with everything that is wrong: unknown keys, cells that are no valid
// scenarios, settings that are not there in the end (another one lies over them), cells that are
// equal, more than kMaxSweepCells. Randomness: core/space_filling.h, with the seed of the
// campaign. Cost: about a millisecond per cell.
Sweep LoadSweep(const std::filesystem::path& path, const SweepChanges& changes = {});

// Returns the same from text; files are relative to `folder`.
Sweep ParseSweep(std::string_view text, const SweepChanges& changes = {},
                 const std::filesystem::path& folder = ".");

// Returns the name of a cell as the name of a file: "0007-k_per_m2_0.01" without an ending.
// Letters, digits and "-._" of the first 100 bytes stay, anything else becomes '_'; the number,
// counted from 1, keeps cells apart. Must stay: files and folders of stored traces have these
// names.
std::string CellFileName(std::size_t index, std::string_view cell_name);

}  // namespace rockyard::scenario
