#include "scenario/scenario.h"

namespace rockyard::scenario {

void Scenario::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Integer("schema_version", schema_version,
            {.doc = "version of this format", .min = 1, .max = 1, .origin = Origin::kSetting});
  v.Text("name", name, {.doc = "short name, used in reports", .origin = Origin::kSetting});
  v.Text("description", description, {.doc = "what it stands for", .origin = Origin::kSetting});
  v.Text("accepted", accepted,
         {.doc = "doubts of `rockyard validate` that are meant so, in its words up to the advice",
          .origin = Origin::kSetting});
  experiment.VisitKind(v);
  v.Integer("trials", trials,
            {.doc = "number of runs", .min = 1, .max = 1e9, .origin = Origin::kSetting});
  v.Integer(
      "seed", seed,
      {.doc = "seed of every random stream", .min = 0, .max = 9e18, .origin = Origin::kSetting});
  drive.Visit(v);
  experiment.VisitGroups(v);
  experiment.RequireConsistency(drive, v);
}

}  // namespace rockyard::scenario
