#include "campaign/mobility/mobility_files.h"

#include "campaign/mobility/mobility_charts.h"
#include "campaign/mobility/mobility_tables.h"
#include "campaign/scenario_names.h"
#include "core/archive.h"
#include "core/json_text.h"
#include "core/provenance.h"
#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

JsonValue SoilsJson(const MobilityResult& result) {
  JsonValue soils = JsonValue::Object();
  for (const MobilityCase& of : result.cases) soils.Set(of.soil, core::WriteParams(of.values));
  return soils;
}

}  // namespace

JsonValue MobilityJson(const MobilityRequest& request, const MobilityResult& result,
                       const std::vector<OutputFile>& files) {
  const MobilityTable tables[] = {SlopeTable(result), WheelTable(result), LimitTable(result)};
  JsonValue json = report::ObjectTree(
      "schema_version", 1, "rover", result.source.name, "parameters",
      core::WriteParams(result.cases.front().rover), "soils", SoilsJson(result), "slip_limit",
      request.slip_limit, "draws", request.draws, "seed", static_cast<std::int64_t>(request.seed));
  JsonValue columns = JsonValue::Object();
  for (const MobilityTable& table : tables) columns.Set(table.name, table.Meanings());
  for (const MobilityTable& table : tables) json.Set(table.name, table.Json());
  json.Set("columns", std::move(columns));
  json.Set("files", FilesJson(files));
  json.Set("program", JsonValue(core::VersionLine()));
  return json;
}

OutputPlan MobilityPlan(const MobilityRequest& request) {
  return {.command = "mobility",
          .names = {"mobility.svg", "slopes.csv", "wheel.csv", "limits.csv", "mobility.json"},
          .inputs = {ScenarioFile(request.rover, Wanted::kRover), request.points}};
}

void WriteMobility(const MobilityRequest& request, const MobilityResult& result,
                   OutputFolder& folder) {
  folder.Write("charts", "mobility.svg", MobilitySvg(request, result));
  folder.Write("slopes", "slopes.csv", SlopeTable(result).Csv());
  folder.Write("wheel", "wheel.csv", WheelTable(result).Csv());
  folder.Write("limits", "limits.csv", LimitTable(result).Csv());
  const auto files = folder.files();
  folder.Write("summary", "mobility.json", core::DumpJson(MobilityJson(request, result, files)));
  folder.Finish();
}

}  // namespace rockyard::campaign
