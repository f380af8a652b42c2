#include "batch/merge_shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/files.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using core::Problem;

struct Part {
  fs::path folder;
  ResultStore store;
};

std::string ShardName(const Shard& shard) {
  return fmt::format("shard {}/{}", shard.index, shard.count);
}

// Finds whatever is wrong with the parts, all at once.
class Inspector {
 public:
  Inspector(const std::vector<Part>& parts, const MergeOptions& options)
      : parts_(parts), options_(options) {}

  std::vector<Problem> Problems() {
    for (const Part& part : parts_) Inspect(part);
    for (std::size_t i = 0; i < folders_.size() && !options_.partial; ++i) {
      if (folders_[i].empty()) missing_.push_back(fmt::format("{}/{}", i + 1, folders_.size()));
    }
    if (!missing_.empty() && problems_.empty()) {
      Add(fmt::format("shards of {}", First().folder.string()),
          fmt::format("are missing: {}", fmt::join(missing_, ", ")),
          "name their folders too, or take what there is with --partial");
    }
    return std::move(problems_);
  }

 private:
  const Part& First() const { return parts_.front(); }

  void Add(std::string path, std::string reason, std::string suggestion) {
    problems_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
  }

  void Inspect(const Part& part) {
    const Shard& shard = part.store.identity().shard;
    if (shard.whole()) {
      Add(part.folder.string(), "holds a whole campaign, not a shard",
          "name folders that `rockyard run` or `rockyard sweep` made with --shard I/N");
      return;
    }
    if (&part != &First() && !BelongsToFirst(part)) return;
    folders_.resize(static_cast<std::size_t>(shard.count));
    std::string& owner = folders_[static_cast<std::size_t>(shard.index - 1)];
    if (!owner.empty()) {
      Add(part.folder.string(), fmt::format("holds {}, and so does {}", ShardName(shard), owner),
          "name each shard once");
    }
    owner = part.folder.string();
    InspectTrials(part);
  }

  bool BelongsToFirst(const Part& part) {
    const CampaignIdentity& first = First().store.identity();
    const CampaignIdentity& own = part.store.identity();
    std::vector<Problem> found =
        CampaignDifferences(own, first, part.store.Builds(), options_.build,
                            {.first = "there", .second = "in the first shard"});
    if (own.shard.count != first.shard.count) {
      found.push_back({"shards",
                       fmt::format("are {} there and {} in the first shard", own.shard.count,
                                   first.shard.count),
                       ""});
    }
    for (int cell = 0; found.empty() && cell < part.store.cells() && !options_.partial; ++cell) {
      const std::int64_t there = part.store.planned(cell);
      if (there == First().store.planned(cell)) continue;
      found.push_back({"trials",
                       fmt::format("planned are {} there and {} in the first shard", there,
                                   First().store.planned(cell)),
                       "run the shorter ones again, by `rockyard run` or `rockyard sweep` with "
                       "--resume and more "
                       "--trials"});
    }
    if (found.empty()) return true;
    Add(part.folder.string(),
        fmt::format("does not go with the shard in {}", First().folder.string()), "");
    problems_.insert(problems_.end(), found.begin(), found.end());
    return false;
  }

  void InspectTrials(const Part& part) {
    // Finished() checks the table: it is asked for shards that may lack trials (--partial), too.
    const std::vector<FinishedTrial> finished_trials = part.store.Finished();
    if (options_.partial) return;
    std::int64_t planned = 0;
    for (int cell = 0; cell < part.store.cells(); ++cell) {
      planned += part.store.identity().shard.Share(part.store.planned(cell));
    }
    const std::int64_t finished = std::count_if(
        finished_trials.begin(), finished_trials.end(), [&](const FinishedTrial& trial) {
          return trial.id.trial < part.store.planned(trial.id.cell);
        });
    if (finished == planned) return;
    Add(part.folder.string(), fmt::format("has {} of {} trials", finished, planned),
        "finish it by the same `rockyard run` or `rockyard sweep` with --resume, or take what "
        "there "
        "is with --partial");
  }

  const std::vector<Part>& parts_;
  const MergeOptions& options_;
  std::vector<std::string> folders_;  // by shard
  std::vector<std::string> missing_;
  std::vector<Problem> problems_;
};

std::vector<std::int64_t> MostPlanned(const std::vector<Part>& parts) {
  std::vector<std::int64_t> planned(static_cast<std::size_t>(parts.front().store.cells()), 0);
  for (const Part& part : parts) {
    for (int cell = 0; cell < part.store.cells(); ++cell) {
      std::int64_t& most = planned[static_cast<std::size_t>(cell)];
      most = std::max(most, part.store.planned(cell));
    }
  }
  return planned;
}

// Trials that are in memory at once and written in one transaction.
constexpr std::int64_t kTrialsOfAPiece = 10000;

void CopyPiece(const ResultStore& from, ResultStore& to, int cell, std::int64_t begin) {
  std::vector<CellRecord> rows;
  for (truth::Record& record : from.Load(cell, begin, begin + kTrialsOfAPiece)) {
    rows.push_back({cell, std::move(record)});
  }
  to.Append(rows);
}

void CopyTrials(const ResultStore& from, ResultStore& to) {
  for (const std::string& build : from.Builds()) to.AddBuild(build);
  for (int cell = 0; cell < from.cells(); ++cell) {
    for (std::int64_t begin = 0; begin < from.planned(cell); begin += kTrialsOfAPiece) {
      CopyPiece(from, to, cell, begin);
    }
  }
  for (const InfrastructureFault& fault : from.InfrastructureFaults()) {
    to.AddInfrastructureFault(fault);
  }
}

[[noreturn]] void FailExists(const fs::path& out) {
  throw StoreError(StoreProblem::kExists, out.string(), "exists", "choose a new folder with --out");
}

void WriteMerged(const std::vector<Part>& parts, const fs::path& folder) {
  CampaignIdentity identity = parts.front().store.identity();
  identity.shard = {};
  ResultStore merged = ResultStore::Create(folder, identity, MostPlanned(parts));
  for (const Part& part : parts) CopyTrials(part.store, merged);
}

// Returns whether the merged store holds in this piece what the part does; trials of other shards
// do not count.
bool HoldsPiece(const ResultStore& merged, const Part& part, int cell, std::int64_t begin) {
  std::vector<truth::Record> there = merged.Load(cell, begin, begin + kTrialsOfAPiece);
  std::erase_if(there, [&](const truth::Record& record) {
    return !part.store.identity().shard.Has(record.trial);
  });
  return TrialHash(there) == TrialHash(part.store.Load(cell, begin, begin + kTrialsOfAPiece));
}

bool HoldsPart(const ResultStore& merged, const Part& part) {
  for (int cell = 0; cell < part.store.cells(); ++cell) {
    for (std::int64_t begin = 0; begin < part.store.planned(cell); begin += kTrialsOfAPiece) {
      if (!HoldsPiece(merged, part, cell, begin)) return false;
    }
  }
  return true;
}

// Returns whether an earlier merge of these parts has made the store: it is of the same campaign
// and holds their trials and no others.
bool HoldsMerge(const ResultStore& merged, const std::vector<Part>& parts, BuildPolicy policy) {
  CampaignIdentity whole = parts.front().store.identity();
  whole.shard = {};
  if (!merged.identity().shard.whole() ||
      !CampaignDifferences(whole, merged.identity(), merged.Builds(), policy).empty()) {
    return false;
  }
  const std::vector<std::int64_t> planned = MostPlanned(parts);
  std::size_t trials = 0;
  for (const Part& part : parts) trials += part.store.Finished().size();
  for (int cell = 0; cell < merged.cells(); ++cell) {
    if (merged.planned(cell) != planned[static_cast<std::size_t>(cell)]) return false;
  }
  return merged.Finished().size() == trials &&
         std::all_of(parts.begin(), parts.end(),
                     [&](const Part& part) { return HoldsPart(merged, part); });
}

// Returns "all" for "all/".
fs::path WithoutSlash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

Merged MergeShards(std::span<const fs::path> shards, const fs::path& out,
                   const MergeOptions& options,
                   const std::function<void(const fs::path&)>& finish) {
  if (shards.empty()) {
    throw StoreError(
        StoreProblem::kMismatch,
        std::vector<Problem>{{"shards", "are none", "name the folders of all shards"}});
  }
  const fs::path target = WithoutSlash(out);
  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(target, error));
  if (exists && !HoldsStore(target)) FailExists(out);
  std::vector<Part> parts;
  for (const fs::path& folder : shards) parts.push_back({folder, ResultStore::Read(folder)});
  std::vector<Problem> problems = Inspector(parts, options).Problems();
  if (!problems.empty()) throw StoreError(StoreProblem::kMismatch, std::move(problems));
  const auto take_what_is_there = [&] {
    if (!HoldsStore(target) || !HoldsMerge(ResultStore::Read(target), parts, options.build)) {
      FailExists(out);
    }
    return Merged::kBefore;
  };
  if (exists) return take_what_is_there();
  // Half of a campaign must not be taken for all of it: the folder gets its name when it is whole.
  const EmptyFolders parents(MakeFolders(target.parent_path()));
  core::RemoveLeftovers(target);
  try {
    core::TemporaryFolder folder(target);
    WriteMerged(parts, folder.path());
    if (finish) finish(folder.path());
    folder.Commit();
    return Merged::kNow;
  } catch (const std::system_error& failure) {
    const int reason = failure.code().value();
    // Another merge may have come first while this one read or wrote.
    if (reason == EEXIST || reason == ENOTEMPTY) return take_what_is_there();
    FailSystem(out, "cannot be made", reason);
  }
}

}  // namespace rockyard::batch
