// Bytes of MCAP files, held against the specification. trace_mcap.test.mjs reads whole traces with
// the library of the format.
#include "replay/mcap_file.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/check.h"
#include "replay/mcap_records.h"

namespace rockyard::replay {
namespace {

using namespace std::string_view_literals;
using testing::ElementsAre;
using testing::SizeIs;

// CRC-32 (IEEE 802.3), bit by bit.
std::uint32_t BitwiseCrc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
  }
  return ~crc;
}

std::string Number(std::uint64_t value, int bytes) {
  std::string text;
  for (int byte = 0; byte < bytes; ++byte) text += static_cast<char>(value >> (8 * byte));
  return text;
}
std::string U16(std::uint64_t value) { return Number(value, 2); }
std::string U32(std::uint64_t value) { return Number(value, 4); }
std::string U64(std::uint64_t value) { return Number(value, 8); }
std::string Crc32(const std::string& bytes) { return U32(BitwiseCrc(bytes)); }

McapFile OneMessage() {
  McapFile file;
  file.AddMetadata("about", {{"a", "b"}});
  file.AddMessage(file.AddChannel("/t", "s", "{}"), 0x0102, "[]");
  return file;
}

// Record by record, from the tables of the specification; lengths and places are counted by hand.
TEST(McapFile, OneMessageAsTheSpecificationLaysItOut) {
  const std::string magic = "\x89MCAP0\r\n";
  const std::string header = "\x01" + U64(16) + U32(0) + U32(8) + "rockyard";
  const std::string metadata =
      "\x0c" + U64(23) + U32(5) + "about" + U32(10) + U32(1) + "a" + U32(1) + "b";
  const std::string schema =
      "\x03" + U64(27) + U16(1) + U32(1) + "s" + U32(10) + "jsonschema" + U32(2) + "{}";
  const std::string channel =
      "\x04" + U64(22) + U16(0) + U16(1) + U32(2) + "/t" + U32(4) + "json" + U32(0);
  const std::string message = "\x05" + U64(24) + U16(0) + U32(0) + U64(258) + U64(258) + "[]";
  const std::string records = schema + channel + message;
  ASSERT_THAT(records, SizeIs(100));
  const std::string chunk = "\x06" + U64(140) + U64(258) + U64(258) + U64(100) + Crc32(records) +
                            U32(0) + U64(100) + records;
  const std::string index = "\x07" + U64(22) + U16(0) + U32(16) + U64(258) + U64(67);
  const std::string data = magic + header + metadata + chunk + index;
  ASSERT_THAT(data, SizeIs(245));
  const std::string end = "\x0f" + U64(4) + Crc32(data);
  const std::string statistics = "\x0b" + U64(56) + U64(1) + U16(1) + U32(1) + U32(0) + U32(1) +
                                 U32(1) + U64(258) + U64(258) + U32(10) + U16(0) + U64(1);
  const std::string metadata_index = "\x0d" + U64(25) + U64(33) + U64(32) + U32(5) + "about";
  const std::string chunk_index = "\x08" + U64(74) + U64(258) + U64(258) + U64(65) + U64(149) +
                                  U32(10) + U16(0) + U64(214) + U64(31) + U32(0) + U64(100) +
                                  U64(100);
  const std::string offsets = "\x0e" + U64(17) + "\x03" + U64(258) + U64(36) +  //
                              "\x0e" + U64(17) + "\x04" + U64(294) + U64(31) +  //
                              "\x0e" + U64(17) + "\x0b" + U64(325) + U64(65) +  //
                              "\x0e" + U64(17) + "\x0d" + U64(390) + U64(34) +  //
                              "\x0e" + U64(17) + "\x08" + U64(424) + U64(83);
  const std::string summary = schema + channel + statistics + metadata_index + chunk_index +
                              offsets + "\x02" + U64(20) + U64(258) + U64(507);
  EXPECT_EQ(OneMessage().Bytes(), data + end + summary + Crc32(summary) + magic);
}

TEST(McapFile, LongOnesHaveChunksOfAMegabyteEachWithItsCrcAndTimes) {
  McapFile file;
  const std::string half(std::size_t{1} << 19, 'x');
  const std::uint16_t first = file.AddChannel("/first", "s", "{}");
  const std::uint16_t second = file.AddChannel("/second", "s", "{}");
  for (std::uint64_t time_ns = 10; time_ns < 15; ++time_ns) {
    file.AddMessage(time_ns % 2 == 0 ? first : second, time_ns, half);
  }
  const std::string bytes = std::move(file).Bytes();
  std::vector<std::string> times;
  std::vector<char> indexes;
  for (const auto& [op, content] : McapRecords(std::string_view(bytes).substr(8))) {
    if (op == '\x07') indexes.push_back(content[0]);
    if (op != '\x06') continue;
    times.emplace_back(content.substr(0, 16));
    EXPECT_EQ(content.substr(24, 4), Crc32(std::string(content.substr(40))));
  }
  EXPECT_THAT(times, ElementsAre(U64(10) + U64(11), U64(12) + U64(13), U64(14) + U64(14)));
  EXPECT_THAT(indexes, ElementsAre(0, 1, 0, 1, 0));
  EXPECT_THAT(McapMessagesIn(bytes), SizeIs(5));
}

TEST(McapFile, WithoutMessagesHasNoChunk) {
  std::string ops;
  const std::string bytes = McapFile().Bytes();
  for (const McapRecord& record : McapRecords(std::string_view(bytes).substr(8))) ops += record.op;
  EXPECT_EQ(ops, "\x01\x0f\x0b\x0e\x02");
}

#ifdef ROCKYARD_CONTRACTS
TEST(McapFile, RefusesTimesThatDescend) {
  McapFile file = OneMessage();
  EXPECT_THROW(file.AddMessage(0, 0x0101, "[]"), core::ContractViolation);
  EXPECT_THROW(file.AddMessage(1, 0x0102, "[]"), core::ContractViolation);
}
#endif

}  // namespace
}  // namespace rockyard::replay
