// Puts the parts of a campaign together.
#pragma once

#include <filesystem>
#include <span>

#include "batch/campaign_differences.h"

namespace rockyard::batch {

struct MergeOptions {
  BuildPolicy build = BuildPolicy::kSame;
  bool partial = false;  // shards may be missing, and trials of a shard, too
};

// Makes a store in `out` with every trial of the shards: what one machine would have written, to
// the same hash, but for the order of the rows. Throws StoreError, with everything that is wrong
// and nothing written: a folder that holds no shard; shards of different campaigns, or of different
// numbers of shards or trials; builds that differ; a shard that is there twice, that is missing, or
// that lacks trials; an `out` that exists, or that another merge makes meanwhile (kInUse, kExists).
// Memory: some thousand records, and for a moment 24 bytes per trial of a shard.
void MergeShards(std::span<const std::filesystem::path> shards, const std::filesystem::path& out,
                 const MergeOptions& options = {});

}  // namespace rockyard::batch
