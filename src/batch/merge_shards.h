// Puts the shards of a campaign together, for `rockyard merge`.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "batch/campaign_differences.h"

namespace rockyard::batch {

struct MergeOptions {
  BuildPolicy build = BuildPolicy::kSame;
  bool partial = false;  // shards may be missing, and trials of a shard, too
};

enum class Merged {
  kNow,     // the folder was made
  kBefore,  // it was there, and holds these trials of this campaign and no others
};

// Makes a store in `out` with every trial of the shards: what one machine would have written, to
// the same hash, but for the order of the rows. The folder appears when it is whole: it is made
// beside `out` under another name, in which `finish` may add files to it. A merge that is killed
// leaves no `out`, and the next one removes what it left.
//
// Throws StoreError, with everything that is wrong and nothing written: a folder that holds no
// shard; shards of different campaigns, or of different numbers of shards or trials; builds that
// differ; a shard that is there twice, that is missing, that lacks trials, or that holds trials of
// another shard. Throws kExists where `out` exists already, or another merge has made it meanwhile;
// but where it holds exactly what would be merged, as after a merge that was killed at its very
// end, it is left as it is (kBefore). What `finish` throws is thrown on. Memory: some thousand
// records, and for a moment 24 bytes per trial of a shard.
Merged MergeShards(std::span<const std::filesystem::path> shards, const std::filesystem::path& out,
                   const MergeOptions& options = {},
                   const std::function<void(const std::filesystem::path& folder)>& finish = {});

}  // namespace rockyard::batch
