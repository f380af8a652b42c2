// What is known of each pair of a path as soon as it is done, so that a path that was cut off can
// go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "campaign/odometry/estimate_path.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

struct PairEntry {
  std::int64_t pair = 0;  // its number in the sequence
  // Without features and points; its numbers are the odometer's, which counts what it is given.
  vision::OdometryStep found;
  std::string unreadable;  // why nobody could look at its images; empty: somebody did
  StageSeconds seconds{};
};

// A line of JSON a pair; reals read back to the same bits, as the path that goes on has to be the
// one that was not cut off. Only the program that began it reads it (OutputFolder): its form may
// change.
class PathJournal {
 public:
  // Entries that the file holds, where there is one; a last line that was cut off is removed from
  // it. Throws core::UserError for what no journal holds, and as Add does.
  explicit PathJournal(std::filesystem::path file);

  const std::vector<PairEntry>& entries() const { return entries_; }

  // Throws core::MachineError where it cannot be written.
  void Add(const PairEntry& entry);

 private:
  [[noreturn]] void FailToWrite() const;

  std::filesystem::path path_;
  std::vector<PairEntry> entries_;
  std::ofstream file_;
};

}  // namespace rockyard::campaign
