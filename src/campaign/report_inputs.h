// What a report is about: the folders that were named, and what each run goes by.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::campaign {

// A run, one cell of a campaign, or a sweep with all its cells.
struct ReportInput {
  std::filesystem::path folder;
  std::string cell;                      // as the user chose it; "" for all there is
  bool sweep = false;                    // all cells of a sweep
  std::vector<std::string> cells;        // names; one, "", of a run
  std::string label;                     // unique among all labels of the report
  std::vector<std::string> cell_labels;  // of a sweep, unique too
};

// Of run folders, sweep folders, and folders of such folders. `cell`: its name or number, of every
// one of them; "" for all cells. Throws core::UserError with everything that is wrong: no run, a
// damaged one, a shard, no such cell, one folder named twice.
std::vector<ReportInput> FindReportInputs(const std::vector<std::string>& paths,
                                          const std::string& cell);

// A label for each list of candidates, which go from short to long: the shortest that no other one
// shares; the last with a number where none is.
std::vector<std::string> UniqueLabels(const std::vector<std::vector<std::string>>& candidates);

}  // namespace rockyard::campaign
