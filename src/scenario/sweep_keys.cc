#include "scenario/sweep_keys.h"

#include <span>

namespace rockyard::scenario {
namespace {

using core::Origin;

// The reader hands free keys over as empty texts, so that they are known and can be suggested.
void VisitFree(core::FieldVisitor& v, std::span<const std::string_view> keys,
               std::span<const std::string_view> docs) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::string ignored;
    v.Text(keys[i], ignored, {.doc = docs[i], .origin = Origin::kSetting});
  }
}

}  // namespace

void DesignParams::Visit(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           {.doc = "grid: every combination of levels; list: the given cells; latin_hypercube and "
                   "sobol: points that cover ranges evenly",
            .origin = Origin::kSetting});
  v.Integer("points", points,
            {.doc = "cells of latin_hypercube and sobol; best a power of 2 for sobol",
             .min = 1,
             .max = static_cast<double>(kMaxSweepCells),
             .origin = Origin::kSetting});
}

void FitParams::Visit(core::FieldVisitor& v) {
  v.Text("axis", axis,
         {.doc = "name of the axis against whose numbers success is fitted; absent: the first "
                 "numeric one",
          .origin = Origin::kSetting});
  v.Choice("scale", scale,
           {.doc = "whether the logit of success is linear in the number or in its logarithm",
            .origin = Origin::kSetting});
}

void SweepParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, {.doc = "what the campaign is called", .origin = Origin::kSetting});
  v.Text("description", description, {.doc = "for people", .origin = Origin::kSetting});
  v.Integer("trials", trials,
            {.doc = "trials per cell; --trials overrides",
             .min = 1,
             .max = 1e9,
             .origin = Origin::kSetting});
  v.Integer("seed", seed,
            {.doc = "seed of the campaign; --seed overrides",
             .min = 0,
             .max = 9e18,
             .origin = Origin::kSetting});
  v.Boolean(
      "common_random_numbers", common_random_numbers,
      {.doc = "whether trials of equal number meet the same rocks and the same noise in every "
              "cell, so that cells can be compared in pairs",
       .origin = Origin::kSetting});
  v.Group("design", design, "which combinations of levels are cells");
  v.Group("fit", fit, "logistic fit of success");
  constexpr std::array<std::string_view, 4> kDocs{
      "file with the base scenario, relative to this one, or an object",
      "PATH: value, on all cells", "what is varied", "cells of design list"};
  VisitFree(v, kFreeSweepKeys, kDocs);
}

void AxisParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name,
         {.doc = "in tables; absent: the last part of the path", .origin = Origin::kSetting});
  v.Text("path", path, {.doc = "parameter that is varied", .origin = Origin::kSetting});
  v.Real("from", from, {.doc = "first value of a range", .origin = Origin::kSetting});
  v.Real("to", to, {.doc = "last value of a range", .origin = Origin::kSetting});
  v.Integer("steps", steps,
            {.doc = "number of values from first to last",
             .min = 2,
             .max = static_cast<double>(kMaxSweepCells),
             .origin = Origin::kSetting});
  v.Choice(
      "scale", scale,
      {.doc = "whether steps are equal differences or equal ratios", .origin = Origin::kSetting});
  v.Text("ablation", ablation,
         {.doc = "two levels: without and with this change of the scenario",
          .origin = Origin::kSetting});
  constexpr std::array<std::string_view, 3> kDocs{"list of values of the parameter",
                                                  "list of {name, set, scenario}",
                                                  "list of scenario files, each a level"};
  VisitFree(v, kFreeAxisKeys, kDocs);
}

void LevelParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, {.doc = "in tables", .origin = Origin::kSetting});
  constexpr std::array<std::string_view, 2> kDocs{
      "PATH: value", "file with a scenario that takes the place of the base"};
  VisitFree(v, kFreeLevelKeys, kDocs);
}

}  // namespace rockyard::scenario
