// Bytes of messages between ranks: the bits of every number, for machines of one kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/campaign.h"

namespace rockyard::batch {

class PacketWriter {
 public:
  PacketWriter& Integer(std::int64_t value);
  PacketWriter& Real(double value);
  PacketWriter& Text(const std::string& text);
  PacketWriter& Trials(const std::vector<TrialId>& trials);
  PacketWriter& Records(const std::vector<CellRecord>& records);

  const std::string& bytes() const { return bytes_; }

 private:
  template <typename Value>
  PacketWriter& Bits(Value value);

  std::string bytes_;
};

// Reads what a PacketWriter wrote, in the same order. Throws
// std::runtime_error where the packet is too short: the ranks are no builds of one program.
class PacketReader {
 public:
  explicit PacketReader(const std::string& bytes) : bytes_(bytes) {}

  bool AtEnd() const { return at_ == bytes_.size(); }

  std::int64_t Integer();
  double Real();
  std::string Text();
  std::vector<TrialId> Trials();
  std::vector<CellRecord> Records();

 private:
  template <typename Value>
  Value Bits();

  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace rockyard::batch
