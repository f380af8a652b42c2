#include "experiments/three_rock_run/columns.h"

#include <utility>

#include "experiments/three_rock_run/three_rock_record.h"

namespace rockyard::experiments {

const truth::RecordSchema& ThreeRockColumns() {
  static const truth::RecordSchema kColumns = [] {
    truth::RecordSchema columns;
    ForEachThreeRockColumn(ThreeRockRecord{}, [&](truth::ValueInfo column, double) {
      columns.push_back(std::move(column));
    });
    return columns;
  }();
  return kColumns;
}

}  // namespace rockyard::experiments
