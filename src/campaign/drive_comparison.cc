#include "campaign/drive_comparison.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "campaign/run_views.h"
#include "statistics/clustered_rate.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

// A run that is read column by column.
class Side {
 public:
  explicit Side(const StoredRun& run)
      : run_(run), store_(batch::ResultStore::Read(run.folder)), view_(ComparedView(run)) {
    const truth::ValueInfo* const layout = truth::FindColumn(run.schema, "layout");
    if (layout == nullptr) return;
    Read({*layout});
    view_.groups = statistics::DependentGroups(view_.schema, view_.records);
  }

  std::size_t trials() const { return run_.records.size(); }

  // With those of the columns that the run has. Valid until the next call.
  const report::ComparedRun& Read(const truth::RecordSchema& columns) {
    view_.schema.clear();
    for (const truth::ValueInfo& column : columns) {
      const truth::ValueInfo* own = truth::FindColumn(run_.schema, column.name);
      if (own != nullptr) view_.schema.push_back(*own);
    }
    view_.records = {};
    records_.clear();
    records_ = store_.Load(run_.cell, view_.schema);
    // A run under way may hold more trials by now.
    records_.resize(std::min(records_.size(), trials()));
    view_.records = batch::ContiguousPrefix(records_);
    return view_;
  }

 private:
  const StoredRun& run_;
  batch::ResultStore store_;
  report::ComparedRun view_;
  std::vector<truth::Record> records_;
};

// Adds what a comparison of other columns of the same trials says.
void AddColumns(report::RunComparison more, report::RunComparison& all) {
  all.shared_layouts = all.shared_layouts || more.shared_layouts;
  const auto append = [](auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  append(more.columns, all.columns);
  append(more.arrived_columns, all.arrived_columns);
}

}  // namespace

report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once) {
  Side a(first);
  Side b(second);
  const std::size_t trials = std::max<std::size_t>(1, a.trials() + b.trials());
  const std::size_t width = std::max<std::size_t>(1, values_at_once / trials);
  const auto compare = [&](std::size_t from) {
    const auto begin = first.schema.begin() + static_cast<std::ptrdiff_t>(from);
    const std::size_t count = std::min(width, first.schema.size() - from);
    const truth::RecordSchema columns(begin, begin + static_cast<std::ptrdiff_t>(count));
    const report::ComparedRun& one = a.Read(columns);
    return report::CompareRuns(one, b.Read(columns));
  };
  report::RunComparison all = compare(0);
  for (std::size_t from = width; from < first.schema.size(); from += width) {
    AddColumns(compare(from), all);
  }
  return all;
}

}  // namespace rockyard::campaign
