// What is known of each pair of a path as soon as it is done. EstimatePath writes it, and by it a
// path that was cut off goes on.
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
  // What the odometer found, without features and points. Its numbers are those of the odometer,
  // which counts what it is given.
  vision::OdometryStep found;
  std::string unreadable;  // why nobody could look at its images; empty: somebody did
  StageSeconds seconds{};
};

// A file with a line of JSON for each pair. Reals must read back to the same bits, as the path that
// goes on has to be the one that was not cut off. Only the program that began the file reads it
// (OutputFolder): its form may change.
class PathJournal {
 public:
  // Reads the entries that the file holds, where there is one; removes a last line that was cut
  // off. Throws core::UserError for what no journal holds, and what Add throws.
  explicit PathJournal(std::filesystem::path file);

  const std::vector<PairEntry>& entries() const { return entries_; }

  // Adds an entry. Throws core::MachineError where it cannot be written.
  void Add(const PairEntry& entry);

 private:
  [[noreturn]] void FailToWrite() const;

  std::filesystem::path path_;
  std::vector<PairEntry> entries_;
  std::ofstream file_;
};

}  // namespace rockyard::campaign
