// Messages with times as an MCAP file (mcap.dev/spec, version 0), which Foxglove, Lichtblick and
// others open. Traces of this form (trace_mcap.h) are such files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rockyard::replay {

// Keys, each once, with their values.
using McapTexts = std::vector<std::pair<std::string, std::string>>;

// Collects messages in JSON. They lie in chunks, which are indexed and not compressed, so that
// every reader opens them. CRCs guard all bytes: those of chunks, of the data and of the summary.
class McapFile {
 public:
  McapFile();

  // Adds what is known of the file as a whole.
  void AddMetadata(std::string_view name, const McapTexts& texts);

  // Adds a topic and returns its channel. Topics must differ, and schemas (JSON Schema) of one name
  // must be the same.
  std::uint16_t AddChannel(std::string_view topic, std::string_view schema_name,
                           std::string_view schema);

  // Adds a message of a channel. Times must not descend.
  void AddMessage(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);

  // Ends the file and returns it. Must stay: the same calls give the same bytes.
  std::string Bytes() &&;

 private:
  // The messages of some stretch of time. Where a message begins counts from the first record.
  struct Chunk {
    std::string records;
    std::uint64_t start_ns = 0;
    std::uint64_t end_ns = 0;
    std::map<std::uint16_t, std::string> index;  // times and places of the messages by channel
  };

  void EndChunk();
  std::string Statistics() const;

  std::string data_;  // from the first byte of the file on, without the chunk that is open
  Chunk chunk_;
  std::map<std::string, std::uint16_t, std::less<>> schema_ids_;
  std::vector<std::uint32_t> messages_;  // of each channel
  std::uint64_t start_ns_ = 0;
  std::uint64_t end_ns_ = 0;
  std::uint32_t chunks_ = 0;
  std::uint32_t metadata_ = 0;
  // Records of the summary.
  std::string schemas_;
  std::string channels_;
  std::string chunk_indexes_;
  std::string metadata_indexes_;
};

}  // namespace rockyard::replay
