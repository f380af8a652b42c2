// What navigators of plugins and processes took by the clocks of the machine: a file beside the
// store, for whoever makes such a navigator quicker. No record, summary or comparison reads it, as
// no drive may depend on a clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "messages/navigation_view.h"

namespace rockyard::campaign {

// navigator_times.csv of a run folder: a line for each drive that has ended, in the order of
// ending, with cell, trial, questions, cpu_s, wall_s and longest_s. A drive that was begun twice
// has two lines; drives on other ranks and of missions have none. Several threads may call it.
class NavigatorTimes {
 public:
  static constexpr const char* kFile = "navigator_times.csv";

  NavigatorTimes() = default;
  ~NavigatorTimes();
  NavigatorTimes(const NavigatorTimes&) = delete;
  NavigatorTimes& operator=(const NavigatorTimes&) = delete;

  // Lines are added to the file of this folder from now on; the file is made with the first.
  void Begin(const std::filesystem::path& folder);
  // Adds a line. What fails is kept for problem(), and ends the writing: no trial fails by it.
  void Add(const std::string& cell, std::uint64_t trial, const messages::NavigatorUse& use);
  // Returns why lines are missing, if some are.
  std::optional<std::string> problem() const;

 private:
  mutable std::mutex mutex_;
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::optional<std::string> problem_;
};

}  // namespace rockyard::campaign
