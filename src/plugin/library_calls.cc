#include "plugin/library_calls.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <stdexcept>

#include "core/error.h"
#include "core/json_text.h"
#include "navigation/navigator_fault.h"
#include "plugin/guarded_call.h"
#include "plugin/library.h"

namespace rockyard::plugin {

namespace fs = std::filesystem;
using navigation::FaultKind;
using navigation::NavigatorFault;

const rockyard_plugin_info& Load(const fs::path& file) {
  // A library is never unloaded: threads of its own may still run in it.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  void* symbol = dlsym(library, ROCKYARD_PLUGIN_FUNCTION);
  if (symbol == nullptr) {
    throw std::runtime_error(
        fmt::format("it has no function {}: it is no plugin of rockyard, or names what it holds "
                    "by no ROCKYARD_PLUGIN",
                    ROCKYARD_PLUGIN_FUNCTION));
  }
  const auto function = reinterpret_cast<rockyard_plugin_function>(symbol);
  const rockyard_plugin_info* info = function();
  if (info == nullptr) throw std::runtime_error("it hands over nothing");
  if (info->abi != ROCKYARD_PLUGIN_ABI) {
    throw std::runtime_error(
        fmt::format("it was built for version {} of the plugin interface, and this program has "
                    "version {}: build it with the headers of this program",
                    info->abi, ROCKYARD_PLUGIN_ABI));
  }
  const std::size_t navigators = info->navigators == nullptr ? 0 : info->navigator_count;
  const std::size_t estimators = info->estimators == nullptr ? 0 : info->estimator_count;
  const std::size_t readers = info->readers == nullptr ? 0 : info->reader_count;
  if (navigators != info->navigator_count || estimators != info->estimator_count ||
      readers != info->reader_count || navigators + estimators + readers == 0) {
    throw std::runtime_error("it has neither navigators nor estimators nor readers of images");
  }
  return *info;
}

namespace {

rockyard_image Image(const messages::LookImage& from) {
  rockyard_image to{};
  to.width = from.width;
  to.height = from.height;
  to.grey = from.grey.data();
  const auto copy = [](const math::Vector3& vector, double* place) {
    std::copy(vector.begin(), vector.end(), place);
  };
  copy(from.camera.C_R, to.C_R);
  copy(from.camera.A_R, to.A_R);
  copy(from.camera.H_R, to.H_R);
  copy(from.camera.V_R, to.V_R);
  return to;
}

}  // namespace

rockyard_rover AbiRover(const messages::RoverBelief& from) {
  rockyard_rover to{};
  to.length_m = from.length_m;
  to.width_m = from.width_m;
  to.belly_clearance_m = from.belly_clearance_m;
  to.wheel_width_m = from.wheel_width_m;
  to.max_rocker_rad = from.max_rocker_rad;
  to.max_bogie_rad = from.max_bogie_rad;
  to.max_tilt_rad = from.max_tilt_rad;
  WriteWheels(from.drive, to);
  return to;
}

rockyard_images AbiImages(const messages::LookImages& from) {
  return {from.number, from.direction == messages::LookDirection::kBehind ? 1 : 0, Image(from.left),
          Image(from.right)};
}

void TakeText(void* to, const char* text, std::size_t bytes) {
  static_cast<std::string*>(to)->assign(text, bytes);
}

std::string TextOf(const rockyard_error& error) {
  return {std::begin(error.text), std::find(std::begin(error.text), std::end(error.text), '\0')};
}

void RequireDone(int result, const rockyard_error& error) {
  if (result != 0) throw std::runtime_error(TextOf(error));
}

const rockyard_plugin_info& LoadedLibrary::info() const {
  const std::lock_guard lock(mutex_);
  if (info_ != nullptr) return *info_;
  if (const std::string now = HashOfLibrary(file_); now != hash_) {
    throw core::MachineError(file_.string(),
                             "was built anew meanwhile: its hash is " + now + ", and was " + hash_,
                             "let it be while it drives, and begin a run of its own");
  }
  try {
    const rockyard_plugin_info& info = Load(file_);
    if (info.navigator_count != navigators_ || info.estimator_count != estimators_ ||
        info.reader_count != readers_) {
      throw std::runtime_error("it holds more or less than when it was asked what it is");
    }
    info_ = &info;
  } catch (const std::runtime_error& error) {
    throw core::UserError(file_.string(), std::string("cannot be loaded: ") + error.what(),
                          "build it anew, and let it be while it is used");
  }
  return *info_;
}

AbiValues::AbiValues(const Parameters& parameters) {
  for (const FieldValue& value : parameters.values()) {
    rockyard_value& to = values_.emplace_back();
    to.real = value.real;
    to.integer = value.boolean ? 1 : value.choice != 0 ? value.choice : value.integer;
    to.text = value.text.c_str();
    to.reals = value.reals.data();
    to.integers = value.integers.data();
    to.count = std::max(value.reals.size(), value.integers.size());
  }
  all_ = {values_.data(), values_.size()};
}

void AbiFelt::Take(const messages::VehicleState& from) {
  felt_ = {};
  if (from.articulation) {
    joints_ = {from.articulation->left_rocker_rad, from.articulation->right_rocker_rad,
               from.articulation->left_bogie_rad, from.articulation->right_bogie_rad};
    felt_.articulation_rad = joints_.data();
  }
  if (from.specific_force_R) felt_.specific_force_R = from.specific_force_R->data();
  if (from.motor_current_A) felt_.motor_current_A = from.motor_current_A->data();
  if (from.contact) {
    std::copy(from.contact->begin(), from.contact->end(), contact_.begin());
    felt_.contact = contact_.data();
  }
}

core::JsonValue AskOfParameters(
    const LoadedLibrary& library, const Parameters& parameters,
    const std::function<SaysOfParameters(const rockyard_plugin_info&)>& function_of) {
  const std::string name = library.file().string();
  const std::string text = InChild(name, [&] {
    const AbiValues values(parameters);
    rockyard_error error{};
    std::string answer;
    const SaysOfParameters says = function_of(Load(library.file()));
    RequireDone(says(values.get(), TakeText, &answer, &error), error);
    return answer;
  });
  return core::ParseJson(text, name);
}

double LibraryCalls::ThreadCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void LibraryCalls::CheckSlow() const {
  const double now_s = ThreadCpu_s();
  const double used_s = now_s - std::exchange(cpu_s_, now_s);
  read_at_ = Clock::now();
  use_.cpu_s += used_s;
  if (used_s > call_cpu_s_) FailSlow(call_cpu_s_, "for one answer");
  if (use_.cpu_s > drive_cpu_s_) FailSlow(drive_cpu_s_, "for one drive");
}

void LibraryCalls::FailSlow(double most_s, const char* what) const {
  throw NavigatorFault(FaultKind::kCpuTime, fmt::format("{}more than {} s {}", who_, most_s, what));
}

void LibraryCalls::Fail(const rockyard_error& error) const {
  throw NavigatorFault(FaultKind::kThrew, who_ + TextOf(error));
}

}  // namespace rockyard::plugin
