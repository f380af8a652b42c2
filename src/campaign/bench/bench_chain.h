// The chain of digests over all drives of an entry: records and actions. Whoever changes one bit of
// one of them, or leaves a drive out, gets another head; the head is what an entry publishes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "batch/campaign.h"
#include "batch/result_store.h"
#include "truth/record.h"

namespace rockyard::campaign {

// Returns the file, below the folder of a run, with what the navigator of a trial answered
// (navigation/action_log.h).
std::filesystem::path ActionFile(std::size_t cell, std::string_view cell_name,
                                 std::uint64_t random_seed);
// Returns the random_seed that the navigator of a trial is set up with.
std::uint64_t NavigatorSeed(std::uint64_t campaign_seed, std::uint64_t trial);

// Returns the actions of a trial; "" where there are none, as where the navigator's crash ended its
// process.
std::string ReadActions(const std::filesystem::path& folder, std::size_t cell,
                        const batch::CellIdentity& identity, std::uint64_t trial);

// What a chain is made of. Must stay: the digest of a link, as published heads hold it: SHA-256
// over the digest before, the cell's name, the trial, its outcome, the bits of its values (NaN as
// one) and the SHA-256 of its actions.
struct ChainLink {
  std::size_t cell = 0;
  std::uint64_t trial = 0;
  std::string digest;

  bool operator==(const ChainLink&) const = default;
};

// Returns the links of all trials of a store, cell by cell and in the order of trials; the first
// follows `start`. Throws core::UserError where a trial is missing.
std::vector<ChainLink> MakeChain(const std::filesystem::path& folder,
                                 const batch::ResultStore& store, std::string_view start);

// A chain as a CSV file, "cell,trial,digest", and back. Throws core::UserError for another text.
std::string ChainCsv(const std::vector<ChainLink>& chain);
std::vector<ChainLink> ParseChain(std::string_view csv, std::string_view source_name);

}  // namespace rockyard::campaign
