#include "batch/communicator.h"

#include <cstring>
#include <stdexcept>
#include <utility>

namespace rockyard::batch {

template <typename Value>
PacketWriter& PacketWriter::Bits(Value value) {
  char bits[sizeof(Value)];
  std::memcpy(bits, &value, sizeof(Value));
  bytes_.append(bits, sizeof(Value));
  return *this;
}

PacketWriter& PacketWriter::Integer(std::int64_t value) { return Bits(value); }

PacketWriter& PacketWriter::Real(double value) { return Bits(value); }

PacketWriter& PacketWriter::Text(const std::string& text) {
  Integer(static_cast<std::int64_t>(text.size()));
  bytes_ += text;
  return *this;
}

PacketWriter& PacketWriter::Trials(const std::vector<TrialId>& trials) {
  Integer(static_cast<std::int64_t>(trials.size()));
  for (const TrialId& id : trials) Integer(id.cell).Integer(id.trial);
  return *this;
}

PacketWriter& PacketWriter::Records(const std::vector<CellRecord>& records) {
  Integer(static_cast<std::int64_t>(records.size()));
  for (const CellRecord& each : records) {
    Integer(each.cell).Integer(static_cast<std::int64_t>(each.record.trial));
    Integer(static_cast<std::int64_t>(each.record.outcome)).Text(each.record.detail);
    Integer(static_cast<std::int64_t>(each.record.values.size()));
    for (const double value : each.record.values) Real(value);
  }
  return *this;
}

template <typename Value>
Value PacketReader::Bits() {
  if (bytes_.size() - at_ < sizeof(Value)) {
    throw std::runtime_error("a message between ranks is cut off");
  }
  Value value;
  std::memcpy(&value, bytes_.data() + at_, sizeof(Value));
  at_ += sizeof(Value);
  return value;
}

std::int64_t PacketReader::Integer() { return Bits<std::int64_t>(); }

double PacketReader::Real() { return Bits<double>(); }

std::string PacketReader::Text() {
  const auto size = static_cast<std::size_t>(Integer());
  if (bytes_.size() - at_ < size) throw std::runtime_error("a message between ranks is cut off");
  at_ += size;
  return bytes_.substr(at_ - size, size);
}

std::vector<TrialId> PacketReader::Trials() {
  std::vector<TrialId> trials;
  for (std::int64_t left = Integer(); left > 0; --left) {
    const auto cell = static_cast<int>(Integer());
    trials.push_back({cell, Integer()});
  }
  return trials;
}

std::vector<CellRecord> PacketReader::Records() {
  std::vector<CellRecord> records;
  for (std::int64_t left = Integer(); left > 0; --left) {
    CellRecord each;
    each.cell = static_cast<int>(Integer());
    each.record.trial = static_cast<std::uint64_t>(Integer());
    each.record.outcome = static_cast<truth::TrialOutcome>(Integer());
    each.record.detail = Text();
    for (std::int64_t values = Integer(); values > 0; --values) {
      each.record.values.push_back(Real());
    }
    records.push_back(std::move(each));
  }
  return records;
}

}  // namespace rockyard::batch
