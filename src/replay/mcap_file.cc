#include "replay/mcap_file.h"

#include <zlib.h>

#include <array>
#include <concepts>

#include "core/check.h"

namespace rockyard::replay {
namespace {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
constexpr std::string_view kUncompressed;
// A chunk is ended by the message with which it becomes this long: what a player reads at once.
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

// Bytes that stand in a record without their length.
struct Raw {
  std::string_view bytes;
};

// Append a field: a number, little-endian, as wide as its type; a text with its length, as which
// lists and maps are written, too.
template <std::unsigned_integral Number>
void AppendField(Number number, std::string& to) {
  for (std::size_t byte = 0; byte < sizeof number; ++byte) {
    to += static_cast<char>((std::uint64_t{number} >> (8 * byte)) & 0xff);
  }
}
void AppendField(Op op, std::string& to) { to += static_cast<char>(op); }
void AppendField(Raw raw, std::string& to) { to += raw.bytes; }
void AppendField(std::string_view text, std::string& to) {
  AppendField(static_cast<std::uint32_t>(text.size()), to);
  to += text;
}

template <typename... Fields>
std::string FieldsOf(const Fields&... fields) {
  std::string bytes;
  (AppendField(fields, bytes), ...);
  return bytes;
}

template <typename... Fields>
std::string RecordOf(Op op, const Fields&... fields) {
  const std::string content = FieldsOf(fields...);
  return FieldsOf(op, std::uint64_t{content.size()}, Raw{content});
}

std::uint32_t Crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

McapFile::McapFile() : data_(kMcapMagic) {
  constexpr std::string_view kProfile;  // none
  constexpr std::string_view kLibrary = "rockyard";
  data_ += RecordOf(Op::kHeader, kProfile, kLibrary);
}

void McapFile::AddMetadata(std::string_view name, const McapTexts& texts) {
  std::string entries;
  for (const auto& [key, text] : texts) entries += FieldsOf(key, text);
  const std::string record = RecordOf(Op::kMetadata, name, entries);
  metadata_indexes_ += RecordOf(Op::kMetadataIndex, data_.size(), record.size(), name);
  data_ += record;
  ++metadata_;
}

std::uint16_t McapFile::AddChannel(std::string_view topic, std::string_view schema_name,
                                   std::string_view schema) {
  constexpr std::string_view kNoMetadata;
  auto found = schema_ids_.find(schema_name);
  if (found == schema_ids_.end()) {
    const auto id = static_cast<std::uint16_t>(schema_ids_.size() + 1);  // 0 stands for none
    found = schema_ids_.emplace(schema_name, id).first;
    const std::string record = RecordOf(Op::kSchema, id, schema_name, "jsonschema", schema);
    chunk_.records += record;
    schemas_ += record;
  }
  const auto channel = static_cast<std::uint16_t>(messages_.size());
  const std::string record =
      RecordOf(Op::kChannel, channel, found->second, topic, "json", kNoMetadata);
  chunk_.records += record;
  channels_ += record;
  messages_.push_back(0);
  return channel;
}

void McapFile::AddMessage(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  EXPECT(channel < messages_.size() && time_ns >= end_ns_);
  if (chunk_.index.empty()) chunk_.start_ns = time_ns;
  if (chunks_ == 0) start_ns_ = chunk_.start_ns;
  chunk_.end_ns = end_ns_ = time_ns;
  chunk_.index[channel] += FieldsOf(time_ns, chunk_.records.size());
  const std::uint32_t sequence = messages_[channel]++;
  const std::uint64_t publish_time_ns = time_ns;
  chunk_.records += RecordOf(Op::kMessage, channel, sequence, time_ns, publish_time_ns, Raw{json});
  if (chunk_.records.size() >= kChunkBytes) EndChunk();
}

void McapFile::EndChunk() {
  const auto& [records, start_ns, end_ns, index] = chunk_;
  const std::uint64_t start = data_.size();
  data_ += RecordOf(Op::kChunk, start_ns, end_ns, records.size(), Crc(records), kUncompressed,
                    records.size(), Raw{records});
  const std::uint64_t length = data_.size() - start;
  std::string offsets;
  for (const auto& [channel, places] : index) {
    offsets += FieldsOf(channel, data_.size());
    data_ += RecordOf(Op::kMessageIndex, channel, places);
  }
  const std::uint64_t index_length = data_.size() - start - length;
  chunk_indexes_ += RecordOf(Op::kChunkIndex, start_ns, end_ns, start, length, offsets,
                             index_length, kUncompressed, records.size(), records.size());
  ++chunks_;
  chunk_ = {};
}

std::string McapFile::Statistics() const {
  constexpr std::uint32_t kNoAttachments = 0;
  std::string counts;
  std::uint64_t all = 0;
  for (std::size_t channel = 0; channel < messages_.size(); ++channel) {
    counts += FieldsOf(static_cast<std::uint16_t>(channel), std::uint64_t{messages_[channel]});
    all += messages_[channel];
  }
  return RecordOf(Op::kStatistics, all, static_cast<std::uint16_t>(schema_ids_.size()),
                  static_cast<std::uint32_t>(messages_.size()), kNoAttachments, metadata_, chunks_,
                  start_ns_, end_ns_, counts);
}

std::string McapFile::Bytes() && {
  if (!chunk_.records.empty()) EndChunk();
  // As the libraries of the format count: from the first byte of the file.
  data_ += RecordOf(Op::kDataEnd, Crc(data_));
  const std::uint64_t summary = data_.size();
  const std::array<std::pair<Op, std::string>, 5> groups{{{Op::kSchema, schemas_},
                                                          {Op::kChannel, channels_},
                                                          {Op::kStatistics, Statistics()},
                                                          {Op::kMetadataIndex, metadata_indexes_},
                                                          {Op::kChunkIndex, chunk_indexes_}}};
  std::string offsets;
  for (const auto& [op, records] : groups) {
    if (records.empty()) continue;
    offsets += RecordOf(Op::kSummaryOffset, op, data_.size(), records.size());
    data_ += records;
  }
  // The CRC of the summary counts the footer up to itself.
  const std::uint64_t offsets_start = data_.size();
  const std::uint32_t no_crc = 0;
  const std::string footer = RecordOf(Op::kFooter, summary, offsets_start, no_crc);
  data_ += offsets + footer.substr(0, footer.size() - sizeof no_crc);
  data_ += FieldsOf(Crc(std::string_view(data_).substr(summary)), Raw{kMcapMagic});
  return std::move(data_);
}

}  // namespace rockyard::replay
