// Every outcome that Matthies 1995 states has a row in a reference, or a reason why it has none.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "report/comparison_reference.h"

namespace rockyard::report {
namespace {

using Ids = std::set<std::string>;

Ids IdsOfReferences() {
  Ids ids;
  for (const char* file : {"matthies1995", "matthies1995_hazard_detection", "matthies1995_mission",
                           "matthies1995_dead_reckoning", "matthies1995_cylinder"}) {
    const auto path = std::string(ROCKYARD_SOURCE_DIR "/results/reference/") + file + ".json";
    for (const auto& value : LoadReference(path).values) {
      EXPECT_TRUE(ids.insert(value.id).second) << value.id << " stands in two references";
    }
  }
  return ids;
}

const std::vector<core::JsonValue>& Targets() {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/matthies1995_targets.json");
  return document.Find("targets")->list();
}

// Names of rows that are not among `ids`, and of targets with neither a row nor a reason.
Ids Unanswered(const Ids& ids) {
  Ids missing;
  for (const core::JsonValue& target : Targets()) {
    const core::JsonValue* rows = target.Find("rows");
    const core::JsonValue* reason = target.Find("reason");
    const bool answered = rows != nullptr ? !rows->list().empty() && reason == nullptr
                                          : reason != nullptr && !reason->text().empty();
    if (!answered) missing.insert(target.Find("id")->text());
    if (rows == nullptr) continue;
    for (const core::JsonValue& row : rows->list()) {
      if (!ids.contains(row.text())) missing.insert(row.text());
    }
  }
  return missing;
}

TEST(PublishedTargets, EachHasARowOrAReason) {
  const Ids ids = IdsOfReferences();
  EXPECT_EQ(Targets().size(), 67u);
  EXPECT_EQ(Unanswered(ids), Ids());
}

// Negative control: a row that is taken out of its reference is missed.
TEST(PublishedTargets, ARowThatIsGoneIsMissed) {
  Ids ids = IdsOfReferences();
  for (const char* id : {"nominal.success", "traverse.hour", "moore.cover_vl2"}) {
    ids.erase(id);
  }
  EXPECT_EQ(Unanswered(ids), (Ids{"nominal.success", "traverse.hour", "moore.cover_vl2"}));
}

}  // namespace
}  // namespace rockyard::report
