#include "report/sweep_outcomes.h"

#include <algorithm>
#include <numeric>

#include "core/check.h"
#include "statistics/paired_counts.h"

namespace rockyard::report {

using statistics::CountOfRun;
using truth::Record;

CellOutcomes::CellOutcomes(std::span<const Record> records, std::int64_t per_layout)
    : per_layout_(static_cast<std::size_t>(per_layout)) {
  EXPECT(per_layout >= 1);
  outcomes_.reserve(records.size());
  for (const Record& record : records) {
    outcomes_.push_back(static_cast<std::uint8_t>(record.outcome));
  }
}

bool CellOutcomes::Succeeded(std::size_t trial, SuccessKind kind) const {
  return kind == SuccessKind::kDeclared ? truth::DeclaredSuccess(Outcome(trial))
                                        : Outcome(trial) == truth::TrialOutcome::kGoalReached;
}

std::vector<CountOfRun> CellOutcomes::ByLayout(SuccessKind kind) const {
  std::vector<CountOfRun> layouts((size() + per_layout_ - 1) / per_layout_);
  for (std::size_t trial = 0; trial < size(); ++trial) {
    if (IsFault(trial)) continue;
    CountOfRun& layout = layouts[trial / per_layout_];
    layout.count += Succeeded(trial, kind) ? 1.0 : 0.0;
    layout.base += 1.0;
  }
  std::erase_if(layouts, [](const CountOfRun& layout) { return layout.base == 0.0; });
  return layouts;
}

std::vector<Record> CellOutcomes::Records() const {
  std::vector<Record> records;
  records.reserve(size());
  for (std::size_t trial = 0; trial < size(); ++trial) {
    records.push_back({trial, Outcome(trial), {}, {}});
  }
  return records;
}

statistics::Interval PairedByLayout(const CellOutcomes& first, const CellOutcomes& second,
                                    SuccessKind kind, double confidence) {
  statistics::ClusteredValues values;
  const std::size_t per_layout = std::lcm(first.per_layout(), second.per_layout());
  for (std::size_t trial = 0; trial < std::min(first.size(), second.size()); ++trial) {
    if (first.IsFault(trial) || second.IsFault(trial)) continue;
    values.Add(trial / per_layout, (second.Succeeded(trial, kind) ? 1.0 : 0.0) -
                                       (first.Succeeded(trial, kind) ? 1.0 : 0.0));
  }
  return AgrestiMinInterval(values.Effective(confidence), confidence);
}

}  // namespace rockyard::report
