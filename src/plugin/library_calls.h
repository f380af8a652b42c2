// What the hosts of a library's navigators, estimators and readers share: the library as it is
// loaded, the messages that both get, and calls whose CPU time is limited.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/json_value.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/look_images.h"
#include "messages/navigation_view.h"
#include "messages/vehicle_state.h"
#include "plugin/abi.h"
#include "plugin/description.h"

namespace rockyard::plugin {

// Loads a library into this process. Throws std::runtime_error with the reason of the loader, or
// where it is no plugin of this version.
const rockyard_plugin_info& Load(const std::filesystem::path& file);

// Takes a text that a library hands over; `to` is a std::string.
void TakeText(void* to, const char* text, std::size_t bytes);

// Returns what a function of a plugin reports, up to the end of the field at most.
std::string TextOf(const rockyard_error& error);

// Throws what a function of a plugin reports as a std::runtime_error.
void RequireDone(int result, const rockyard_error& error);

// A library that has a hash, and is loaded into this process when the first drive begins. Shared by
// all kinds of it.
class LoadedLibrary {
 public:
  // `navigators`, `estimators`, `readers`: how many it described.
  LoadedLibrary(std::filesystem::path file, std::string hash, std::size_t navigators,
                std::size_t estimators, std::size_t readers)
      : file_(std::move(file)),
        hash_(std::move(hash)),
        navigators_(navigators),
        estimators_(estimators),
        readers_(readers) {}

  const std::filesystem::path& file() const { return file_; }
  // Returns what it holds. Throws core::MachineError where the file is another one by now,
  // core::UserError where it cannot be loaded.
  const rockyard_plugin_info& info() const;

 private:
  const std::filesystem::path file_;
  const std::string hash_;
  const std::size_t navigators_;
  const std::size_t estimators_;
  const std::size_t readers_;
  mutable std::mutex mutex_;
  mutable const rockyard_plugin_info* info_ = nullptr;
};

// The values of parameters as the C interface has them; views of `parameters`.
class AbiValues {
 public:
  explicit AbiValues(const Parameters& parameters);
  AbiValues(const AbiValues&) = delete;
  AbiValues& operator=(const AbiValues&) = delete;

  const rockyard_values* get() const { return &all_; }

 private:
  std::vector<rockyard_value> values_;
  rockyard_values all_{};
};

// A VehicleState as the C interface has it; views of `from`.
class AbiFelt {
 public:
  AbiFelt() = default;
  explicit AbiFelt(const messages::VehicleState& from) { Take(from); }
  AbiFelt(const AbiFelt&) = delete;
  AbiFelt& operator=(const AbiFelt&) = delete;

  void Take(const messages::VehicleState& from);
  const rockyard_felt* get() const { return &felt_; }

 private:
  rockyard_felt felt_{};
  std::array<std::uint8_t, messages::kContactSwitchCount> contact_{};
  std::array<double, 4> joints_{};
};

// Return what is believed of the rover, and the images of a look, as the C interface has them;
// greys are views of `from`.
rockyard_rover AbiRover(const messages::RoverBelief& from);
rockyard_images AbiImages(const messages::LookImages& from);

// Writes what is believed of the wheels: into a rockyard_rover or a rockyard_estimator_setup.
template <typename To>
void WriteWheels(const messages::DriveCalibration& from, To& to) {
  to.wheel_radius_m = from.wheel_radius_m;
  to.max_wheel_speed_m_s = from.max_wheel_speed_m_s;
  to.max_steer_rad = from.max_steer_rad;
  to.steering_offset_rad = from.steering_offset_rad;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    to.wheel_x_m[wheel] = from.wheel_x_m[wheel];
    to.wheel_y_m[wheel] = from.wheel_y_m[wheel];
    to.radius_ratio[wheel] = from.radius_ratio[wheel];
    to.steered[wheel] = from.steered[wheel] ? 1 : 0;
  }
}

// Asks a library in a child process what it says of parameters, in JSON: by the function that
// `function_of(info)` returns. Throws core::UserError.
using SaysOfParameters = int (*)(const rockyard_values*, rockyard_take_text, void*,
                                 rockyard_error*);
core::JsonValue AskOfParameters(
    const LoadedLibrary& library, const Parameters& parameters,
    const std::function<SaysOfParameters(const rockyard_plugin_info&)>& function_of);

// The calls of one drive to one navigator or estimator. One thread after the other makes them.
class LibraryCalls {
 public:
  // `who` stands before the reason of a fault.
  LibraryCalls(std::string who, double call_cpu_s, double drive_cpu_s)
      : who_(std::move(who)), call_cpu_s_(call_cpu_s), drive_cpu_s_(drive_cpu_s) {}

  // Calls a function of the library, and judges what it took. A navigator may be called at every
  // tick, so that what costs a system call is asked for slow calls alone. Throws
  // navigation::NavigatorFault.
  template <typename Function>
  void Call(const Function& function) const {
    const Clock::time_point began = Clock::now();
    if (began - read_at_ > kShort) ReadCpuTime(began);
    rockyard_error error{};
    const int result = function(&error);
    const Clock::duration took = Clock::now() - began;
    // A plugin that forks: its child must not go on with this drive and this store.
    if (took > kForkTakes && getpid() != process_) _exit(1);
    const double took_s = std::chrono::duration<double>(took).count();
    use_.wall_s += took_s;
    use_.longest_s = std::max(use_.longest_s, took_s);
    if (took > kShort) {
      CheckSlow();
    } else {
      use_.cpu_s += took_s;
      if (use_.cpu_s > drive_cpu_s_) FailSlow(drive_cpu_s_, "for one drive");
    }
    if (result != 0) Fail(error);
  }

  // Counts a question among all calls.
  void CountQuestion() const { ++use_.questions; }
  // Return what all calls took, and take it back to what it was: a drive that is watched is the
  // same as one that is not.
  const messages::NavigatorUse& use() const { return use_; }
  void ResetUse(const messages::NavigatorUse& use) const { use_ = use; }
  const std::string& who() const { return who_; }

 private:
  using Clock = std::chrono::steady_clock;
  // No call in which a process forks takes less.
  static constexpr std::chrono::microseconds kForkTakes{20};
  // What calls that are no longer take by the clock on the wall counts as CPU time.
  static constexpr std::chrono::milliseconds kShort{1};

  static double ThreadCpu_s();
  void ReadCpuTime(Clock::time_point now) const {
    cpu_s_ = ThreadCpu_s();
    read_at_ = now;
  }
  // Judges a slow call by the CPU time of the thread, in which it may have waited.
  void CheckSlow() const;
  [[noreturn]] void FailSlow(double most_s, const char* what) const;
  [[noreturn]] void Fail(const rockyard_error& error) const;

  const std::string who_;
  const double call_cpu_s_;
  const double drive_cpu_s_;
  const pid_t process_ = getpid();
  mutable double cpu_s_ = ThreadCpu_s();  // of the thread, at most kShort before a call
  mutable Clock::time_point read_at_ = Clock::now();
  mutable messages::NavigatorUse use_;  // in all calls
};

}  // namespace rockyard::plugin
