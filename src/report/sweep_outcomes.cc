#include "report/sweep_outcomes.h"

#include <algorithm>

#include "core/check.h"

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

std::vector<std::size_t> CellOutcomes::Groups() const {
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; SharesLayouts() && i < size(); ++i) groups.push_back(i / per_layout_);
  return groups;
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

}  // namespace rockyard::report
