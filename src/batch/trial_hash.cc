#include "batch/trial_hash.h"

#include "core/hash.h"

namespace rockyard::batch {

std::string TrialHash(std::span<const truth::Record> records) {
  core::Hasher hasher;
  hasher.Integer(records.size());
  for (const truth::Record& record : records) {
    hasher.Integer(record.trial).Text(truth::Name(record.outcome)).Integer(record.values.size());
    for (const double value : record.values) hasher.Real(value);
  }
  return core::Hex(hasher.value());
}

std::string CampaignHash(std::span<const CellHash> cells) {
  if (cells.size() == 1) return cells.front().hash;
  core::Hasher hasher;
  for (const CellHash& cell : cells) hasher.Text(cell.name).Text(cell.hash);
  return core::Hex(hasher.value());
}

}  // namespace rockyard::batch
