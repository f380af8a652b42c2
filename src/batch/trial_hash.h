// One number for all records of a run. Summaries, reports, baselines, replays and tests tell by it
// whether records are equal.
#pragma once

#include <span>
#include <string>

#include "truth/record.h"

namespace rockyard::batch {

// Returns FNV-1a 64 (core/hash.h), 16 hexadecimal digits, over the number of records, and the trial
// index, outcome name, number of values and bits of every value of each record, in the order given:
// pass records in trial order. The sentence for people (`detail`) is left out. Equal hashes mean
// equal records, whatever threads, order or interruptions made them. Must stay: what enters a hash,
// and in which order, since summaries, baselines and tests keep these numbers.
std::string TrialHash(std::span<const truth::Record> records);

struct CellHash {
  std::string name;
  std::string hash;  // TrialHash
};

// Returns the hash of a campaign: that of its cell where there is one, else over name and hash of
// each cell in order. Must stay, as TrialHash.
std::string CampaignHash(std::span<const CellHash> cells);

}  // namespace rockyard::batch
