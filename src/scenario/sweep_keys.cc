#include "scenario/sweep_keys.h"

#include <span>

namespace rockyard::scenario {
namespace {

using core::Setting;

// Lists free keys, so that they are known and can be suggested. PartReader::Fixed hands them over
// as empty texts.
void VisitFree(core::FieldVisitor& v, std::span<const std::string_view> keys,
               std::span<const std::string_view> docs) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::string ignored;
    v.Text(keys[i], ignored, Setting(docs[i]));
  }
}

}  // namespace

void DesignParams::Visit(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           Setting("grid: every combination of levels; list: the given cells; latin_hypercube and "
                   "sobol: points that cover ranges evenly"));
  v.Integer("points", points,
            Setting("cells of latin_hypercube and sobol; best a power of 2 for sobol",
                    {1, static_cast<double>(kMaxSweepCells)}));
}

void FitParams::Visit(core::FieldVisitor& v) {
  v.Text("axis", axis,
         Setting("name of the axis against whose numbers success is fitted; absent: the first "
                 "numeric one"));
  v.Choice("scale", scale,
           Setting("whether the logit of success is linear in the number or in its logarithm"));
}

void SweepParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, Setting("what the campaign is called"));
  v.Text("description", description, Setting("for people"));
  v.Integer("trials", trials, Setting("trials per cell; --trials overrides", {1, 1e9}));
  v.Integer("seed", seed, Setting("seed of the campaign; --seed overrides", {0, 9e18}));
  v.Boolean("common_random_numbers", common_random_numbers,
            Setting("whether trials of equal number meet the same rocks and the same noise in "
                    "every cell, so that cells can be compared in pairs"));
  v.Group("design", design, "which combinations of levels are cells");
  v.Group("fit", fit, "logistic fit of success");
  constexpr std::array<std::string_view, 4> kDocs{
      "file with the base scenario, relative to this one, or an object",
      "PATH: value, on all cells", "what is varied", "cells of design list"};
  VisitFree(v, kFreeSweepKeys, kDocs);
}

void AxisParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, Setting("in tables; absent: the last part of the path"));
  v.Text("path", path, Setting("parameter that is varied"));
  v.Real("from", from, Setting("first value of a range"));
  v.Real("to", to, Setting("last value of a range"));
  v.Integer(
      "steps", steps,
      Setting("number of values from first to last", {2, static_cast<double>(kMaxSweepCells)}));
  v.Choice("scale", scale, Setting("whether steps are equal differences or equal ratios"));
  v.Text("ablation", ablation, Setting("two levels: without and with this change of the scenario"));
  constexpr std::array<std::string_view, 3> kDocs{"list of values of the parameter",
                                                  "list of {name, set, scenario}",
                                                  "list of scenario files, each a level"};
  VisitFree(v, kFreeAxisKeys, kDocs);
}

void LevelParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, Setting("in tables"));
  constexpr std::array<std::string_view, 2> kDocs{
      "PATH: value", "file with a scenario that takes the place of the base"};
  VisitFree(v, kFreeLevelKeys, kDocs);
}

}  // namespace rockyard::scenario
