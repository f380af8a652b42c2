#include "campaign/report_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "campaign/run_source.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Whole and without a trailing separator, so that the last part is the folder's name.
fs::path Absolute(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(folder, error);
  if (error) path = fs::absolute(folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

// "nominal", "runs/nominal", "results/runs/nominal", ...
std::vector<std::string> FolderNames(const fs::path& folder) {
  std::vector<std::string> names;
  fs::path name;
  fs::path rest = Absolute(folder);
  for (; rest.has_filename(); rest = rest.parent_path()) {
    name = name.empty() ? rest.filename() : rest.filename() / name;
    names.push_back(name.string());
  }
  if (names.empty()) names.push_back(folder.string());
  return names;
}

std::vector<std::string> With(std::vector<std::string> names, const std::string& cell) {
  for (std::string& name : names) name += ": " + cell;
  return names;
}

ReportInput Open(const fs::path& folder, const std::string& cell) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  ReportInput input;
  input.folder = folder;
  input.cell = cell;
  if (!store.identity().shard.whole() || !cell.empty()) {
    // Says what is wrong, the same way as every other command.
    const StoredRun run = ReadRun(folder, cell.empty() ? "0" : cell);
    RequireWhole(run);
    input.cells = {run.identity.name};
    return input;
  }
  input.sweep = !store.identity().design.empty();
  for (const batch::CellIdentity& each : store.identity().cells) input.cells.push_back(each.name);
  return input;
}

void AddLabels(std::vector<ReportInput>& inputs) {
  std::vector<std::vector<std::string>> candidates;
  for (const ReportInput& input : inputs) {
    const std::vector<std::string> folders = FolderNames(input.folder);
    const bool one_cell = !input.sweep && !input.cells.front().empty();
    candidates.push_back(one_cell ? With(folders, input.cells.front()) : folders);
    for (std::size_t i = 0; input.sweep && i < input.cells.size(); ++i) {
      candidates.push_back(With(folders, input.cells[i]));
      candidates.back().insert(candidates.back().begin(), input.cells[i]);
    }
  }
  const std::vector<std::string> labels = UniqueLabels(candidates);
  auto next = labels.begin();
  for (ReportInput& input : inputs) {
    input.label = *next++;
    const auto end = next + (input.sweep ? static_cast<std::ptrdiff_t>(input.cells.size()) : 0);
    input.cell_labels.assign(next, end);
    next = end;
  }
}

}  // namespace

std::vector<std::string> UniqueLabels(const std::vector<std::vector<std::string>>& candidates) {
  std::vector<std::size_t> level(candidates.size(), 0);
  const auto label = [&](std::size_t i) { return candidates[i][level[i]]; };
  // Every round makes a label longer, so that it ends.
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, int> uses;
    for (std::size_t i = 0; i < candidates.size(); ++i) ++uses[label(i)];
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (uses[label(i)] < 2 || level[i] + 1 >= candidates[i].size()) continue;
      ++level[i];
      changed = true;
    }
  }
  std::vector<std::string> labels;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::string unique = label(i);
    for (int number = 2; !taken.insert(unique).second; ++number) {
      unique = fmt::format("{} ({})", label(i), number);
    }
    labels.push_back(unique);
  }
  return labels;
}

std::vector<ReportInput> FindReportInputs(const std::vector<std::string>& paths,
                                          const std::string& cell) {
  std::vector<ReportInput> inputs;
  std::vector<core::Problem> problems;
  std::set<fs::path> known;
  for (const std::string& path : paths) {
    try {
      for (const fs::path& folder : batch::FindRuns(path)) {
        if (!known.insert(Absolute(folder)).second) {
          throw core::UserError(folder.string(), "is named twice", "name each run once");
        }
        inputs.push_back(Open(folder, cell));
      }
    } catch (const core::UserError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  AddLabels(inputs);
  return inputs;
}

}  // namespace rockyard::campaign
