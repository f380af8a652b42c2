#include "campaign/odometry/path_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
constexpr auto kCounts =
    std::to_array({&vision::MotionCounts::features_first, &vision::MotionCounts::features_second,
                   &vision::MotionCounts::matches, &vision::MotionCounts::points,
                   &vision::MotionCounts::consistent, &vision::MotionCounts::iterations});

// Returns rotation and translation, row by row, then the covariance.
JsonValue MotionJson(const std::optional<vision::Motion>& motion) {
  if (!motion) return {};
  std::vector<double> numbers;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) numbers.push_back(motion->X_FS(i, j));
  }
  for (const double entry : motion->covariance.reshaped()) numbers.push_back(entry);
  return core::ListOf(numbers);
}

JsonValue EntryJson(const PairEntry& entry) {
  const vision::MotionResult& result = entry.found.result;
  std::array<std::int64_t, kCounts.size()> counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = result.counts.*kCounts[i];
  return report::ObjectTree(
      "pair", entry.pair, "number", entry.found.number, "reference", entry.found.reference,
      "keyframe", entry.found.keyframe, "rms_px", result.rms_px, "unreadable", entry.unreadable,
      "motion", MotionJson(result.motion), "reason",
      result.reason ? JsonValue(static_cast<int>(*result.reason)) : JsonValue(), "counts",
      core::ListOf(counts), "seconds", core::ListOf(entry.seconds));
}

// Reads what EntryJson wrote. Throws std::exception for anything else.
class EntryReader {
 public:
  explicit EntryReader(const JsonValue& json) : json_(json) {}

  PairEntry Read() const {
    PairEntry entry;
    entry.pair = At("pair").integer();
    entry.found.number = At("number").integer();
    entry.found.reference = At("reference").integer();
    entry.found.keyframe = At("keyframe").boolean();
    entry.unreadable = At("unreadable").text();
    vision::MotionResult& result = entry.found.result;
    result.rms_px = At("rms_px").number();
    if (!IsNull("motion")) result.motion = ReadMotion();
    if (!IsNull("reason")) result.reason = ReadReason();
    const JsonValue::List& counts = At("counts").list();
    if (counts.size() != kCounts.size()) throw std::out_of_range("other counts");
    for (std::size_t i = 0; i < counts.size(); ++i) {
      result.counts.*kCounts[i] = counts[i].integer();
    }
    const std::vector<double> seconds = Numbers("seconds", entry.seconds.size());
    std::copy(seconds.begin(), seconds.end(), entry.seconds.begin());
    return entry;
  }

 private:
  const JsonValue& At(std::string_view key) const {
    const JsonValue* value = json_.Find(key);
    if (value == nullptr) throw std::out_of_range("no " + std::string(key));
    return *value;
  }
  bool IsNull(std::string_view key) const { return At(key).Is(JsonValue::Type::kNull); }

  std::vector<double> Numbers(std::string_view key, std::size_t count) const {
    std::vector<double> numbers;
    for (const JsonValue& number : At(key).list()) numbers.push_back(number.number());
    if (numbers.size() != count) throw std::out_of_range("other " + std::string(key));
    return numbers;
  }

  vision::NoMotion ReadReason() const {
    const auto reason = static_cast<std::size_t>(At("reason").integer());
    if (reason >= core::EnumNames<vision::NoMotion>::kNames.size()) {
      throw std::out_of_range("no such reason");
    }
    return static_cast<vision::NoMotion>(reason);
  }

  vision::Motion ReadMotion() const {
    vision::Motion motion;
    const std::vector<double> numbers = Numbers("motion", 12 + 36);
    for (int i = 0; i < 12; ++i) motion.X_FS(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
    std::copy(numbers.begin() + 12, numbers.end(), motion.covariance.data());
    return motion;
  }

  const JsonValue& json_;
};

PairEntry EntryOf(const fs::path& file, std::size_t line, std::string_view text) {
  try {
    return EntryReader(core::ParseJson(text, file.string())).Read();
  } catch (const std::exception& error) {
    throw core::UserError(
        file.string(), fmt::format("line {} is no pair of a path: {}", line, error.what()),
        "begin anew in another folder, or set this one aside by --force in place of --resume");
  }
}

}  // namespace

PathJournal::PathJournal(fs::path file) : path_(std::move(file)) {
  if (fs::exists(path_)) {
    const std::string text = core::ReadTextFile(path_, kMaxBytes, "a journal");
    std::size_t at = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', at)) {
      const std::string_view line = std::string_view(text).substr(at, end - at);
      entries_.push_back(EntryOf(path_, entries_.size() + 1, line));
      at = end + 1;
    }
    if (at < text.size()) fs::resize_file(path_, at);
  }
  file_.open(path_, std::ios::app | std::ios::binary);
  if (!file_) FailToWrite();
}

void PathJournal::Add(const PairEntry& entry) {
  file_ << core::CompactJson(EntryJson(entry)) << '\n' << std::flush;
  if (!file_) FailToWrite();
}

void PathJournal::FailToWrite() const {
  // A path that was begun cannot go on: it counts as a failure of the machine, also where a right
  // to write is missing.
  const std::error_code error(errno, std::generic_category());
  throw core::MachineError(path_.string(), "cannot be written: " + error.message(),
                           "check the free space and the permissions of its folder");
}

}  // namespace rockyard::campaign
