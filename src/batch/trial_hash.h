// One number for all records of a run.
#pragma once

#include <span>
#include <string>

#include "truth/record.h"

namespace rockyard::batch {

// FNV-1a 64 (core/hash.h), 16 hexadecimal digits, over trial index, outcome name and the bits of
// every value of each record, in the order given: pass records in trial order. The sentence for
// people (`detail`) is left out. Equal hashes mean equal records, whatever threads, order or
// interruptions made them. Summaries, baselines and tests keep these numbers: what enters a hash,
// and in which order, is fixed.
std::string TrialHash(std::span<const truth::Record> records);

struct CellHash {
  std::string name;
  std::string hash;  // TrialHash
};

// The hash of a campaign: that of its cell where there is one, else over name and hash of each cell
// in order.
std::string CampaignHash(std::span<const CellHash> cells);

}  // namespace rockyard::batch
