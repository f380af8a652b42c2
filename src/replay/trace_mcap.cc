#include "replay/trace_mcap.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "replay/mcap_file.h"
#include "replay/mcap_messages.h"
#include "replay/mcap_schemas.h"

namespace rockyard::replay {
namespace {

// The version of the messages, as README.md of this folder lists them.
constexpr int kMcapVersion = 1;

void AddRecordMetadata(const ReplayData& data, McapFile& file) {
  McapTexts values;
  McapTexts units;
  for (std::size_t i = 0; i < std::min(data.schema.size(), data.record.values.size()); ++i) {
    values.emplace_back(data.schema[i].name, core::JsonNumber(data.record.values[i]));
    units.emplace_back(data.schema[i].name, data.schema[i].unit);
  }
  file.AddMetadata("rockyard.record", values);
  file.AddMetadata("rockyard.record_units", units);
}

void AddTrialMetadata(const ReplayData& data, McapFile& file) {
  file.AddMetadata("rockyard.trial", {{"format", "rockyard trace"},
                                      {"version", std::to_string(kMcapVersion)},
                                      {"scenario", data.scenario},
                                      {"cell", data.cell},
                                      {"seed", std::to_string(data.seed)},
                                      {"trial", std::to_string(data.record.trial)},
                                      {"outcome", std::string(truth::Name(data.record.outcome))},
                                      {"detail", data.record.detail},
                                      {"record_hash", data.record_hash},
                                      {"overlay_every", std::to_string(data.overlay_every)}});
  AddRecordMetadata(data, file);
  const core::Provenance& made = data.provenance;
  file.AddMetadata("rockyard.provenance", {{"version", made.version},
                                           {"commit", made.commit},
                                           {"compiler", made.compiler},
                                           {"flags", made.flags},
                                           {"build_type", made.build_type},
                                           {"host", made.host},
                                           {"cpu_level", made.cpu_level}});
}

// Returns all messages in the order of time; of one moment in the order in which they were added.
McapMessages MessagesOf(const ReplayData& data) {
  McapMessages messages;
  AddSceneMessages(data, messages);
  AddMotionMessages(data, messages);
  AddPerceptMessages(data, messages);
  std::stable_sort(messages.begin(), messages.end(), [](const auto& a, const auto& b) {
    return Nanoseconds(a.time_s) < Nanoseconds(b.time_s);
  });
  return messages;
}

}  // namespace

std::string TraceMcap(const ReplayData& data) {
  McapFile file;
  AddTrialMetadata(data, file);
  std::map<std::string, std::uint16_t> channels;
  for (const McapMessage& message : MessagesOf(data)) {
    auto found = channels.find(message.topic);
    if (found == channels.end()) {
      const std::uint16_t channel =
          file.AddChannel(message.topic, message.schema, McapSchema(message.schema));
      found = channels.emplace(message.topic, channel).first;
    }
    file.AddMessage(found->second, Nanoseconds(message.time_s), message.json);
  }
  return std::move(file).Bytes();
}

}  // namespace rockyard::replay
