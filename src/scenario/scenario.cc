#include "scenario/scenario.h"

namespace rockyard::scenario {

using core::Setting;

// Must stay in this order: resolved scenarios have it, and fingerprints depend on their text.
// Conditions across modules come last, when every group has been read.
void Scenario::Visit(core::FieldVisitor& v) {
  v.Integer("schema_version", schema_version, Setting("version of this format", {1, 1}));
  v.Text("name", name, Setting("short name, used in reports"));
  v.Text("description", description, Setting("what it stands for"));
  v.Text("accepted", accepted,
         Setting("doubts of `rockyard validate` that are meant so, in its words up to the advice"));
  experiment.VisitChoice(v);
  v.Integer("trials", trials, Setting("number of runs", {1, 1e9}));
  v.Integer("seed", seed, Setting("seed of every random stream", {0, 9e18}));
  drive.Visit(v);
  experiment.VisitGroups(v);
  experiment.chosen().Require(drive, v);
}

}  // namespace rockyard::scenario
