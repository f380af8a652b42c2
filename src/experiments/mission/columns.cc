#include "experiments/mission/columns.h"

#include "experiments/mission/mission_record.h"

namespace rockyard::experiments {

const truth::RecordSchema& MissionColumns() {
  static const truth::RecordSchema kColumns = [] {
    truth::RecordSchema columns;
    ForEachMissionColumn(MissionRecord({}, {}), [&](const truth::ValueInfo& column, double) {
      columns.push_back(column);
    });
    return columns;
  }();
  return kColumns;
}

}  // namespace rockyard::experiments
