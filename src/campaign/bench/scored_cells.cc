#include "campaign/bench/scored_cells.h"

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

std::size_t ColumnOf(const truth::RecordSchema& schema, std::string_view name) {
  return static_cast<std::size_t>(truth::FindColumn(schema, name) - schema.data());
}

}  // namespace

std::string GroupOf(const std::string& cell) { return cell.substr(0, cell.find('/')); }

ScoredCells ReadScoredCells(const BenchRun& run, const batch::ResultStore& store) {
  const truth::RecordSchema& schema = store.identity().schema;
  const std::size_t way = ColumnOf(schema, "true_distance_m");
  const std::size_t to_goal = ColumnOf(schema, "true_goal_distance_m");
  const std::size_t time = ColumnOf(schema, "active_time_s");
  const std::size_t energy = ColumnOf(schema, "active_energy_wh");
  const std::size_t scrapes = ColumnOf(schema, "scrapes");
  const std::size_t no_progress = ColumnOf(schema, "no_progress_distance_m");
  ScoredCells cells;
  std::map<std::string, int> sizes;
  for (int i = 0; i < store.cells(); ++i) {
    ScoredCell cell;
    cell.name = store.identity().cells.at(static_cast<std::size_t>(i)).name;
    ++sizes[GroupOf(cell.name)];
    for (const truth::Record& record : store.Load(i)) {
      ScoredDrive drive;
      drive.outcome = record.outcome;
      drive.arrived = TrueSuccess(record.outcome);
      drive.declared = DeclaredSuccess(record.outcome);
      drive.unsafe = record.outcome == truth::TrialOutcome::kTipOver ||
                     record.outcome == truth::TrialOutcome::kHighCentred;
      if (!record.values.empty()) {
        drive.scraped = record.values.at(scrapes) > 0.0;
        drive.no_progress_m = record.values.at(no_progress);
        drive.way_m = record.values.at(way);
        drive.to_goal_m = record.values.at(to_goal);
        drive.time_s = record.values.at(time);
        drive.energy_wh = record.values.at(energy);
      }
      cell.drives.push_back(drive);
    }
    if (static_cast<std::int64_t>(cell.drives.size()) != run.layouts) {
      throw core::UserError(run.folder.string(), "lacks drives of " + cell.name,
                            "go on with the run: rockyard bench run ... --resume");
    }
    cells.push_back(std::move(cell));
  }
  const auto groups = static_cast<double>(sizes.size());
  for (ScoredCell& cell : cells) cell.weight = 1.0 / (groups * sizes[GroupOf(cell.name)]);
  return cells;
}

void SetRegrets(ScoredCells& cells, const OptimisticWays& optimist) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < cells[c].drives.size(); ++i) {
      ScoredDrive& drive = cells[c].drives[i];
      if (!drive.arrived) continue;
      drive.regret = (drive.way_m + drive.to_goal_m) / optimist.ways_m.at(c).at(i) - 1.0;
    }
  }
}

}  // namespace rockyard::campaign
