// A plugin written to the C interface, as from another language. It says and hands over what its
// parameters tell, right or wrong, and writes to stdout as it is loaded and asked.
#include <cstdio>
#include <cstring>
#include <new>

#include "plugin/abi.h"

namespace {

void Say(const char* text) {
  std::puts(text);
  std::fflush(stdout);
}

const bool kLoaded = [] {
  Say("noise of a plugin that is loaded");
  return true;
}();

// In the order of the description.
enum Parameter { kStatus, kMotion, kDirection, kLook, kSpeed, kOps, kFails, kMakesNone };

constexpr const char* kDescription = R"({
  "name": "plain", "doc": "of the C interface",
  "parameters": [
    {"name": "status", "type": "integer", "default": 0},
    {"name": "motion", "type": "integer", "default": 0},
    {"name": "direction", "type": "integer", "default": 1},
    {"name": "look", "type": "integer", "default": 0},
    {"name": "speed", "type": "real", "default": 1},
    {"name": "ops", "type": "real", "default": 0},
    {"name": "fails", "type": "boolean", "default": false},
    {"name": "makes_none", "type": "boolean", "default": false}],
  "own_values": [{"name": "asked", "unit": "1", "meaning": "how often"}]})";

constexpr const char* kTraits =
    R"({"reads": "nothing", "goal_tolerance": {"parameter": "speed", "value_m": 0.5}})";

struct Plain {
  rockyard_decision decision;
  bool fails;
  double asked;
};

int Describe(rockyard_take_text take, void* to, rockyard_error*) {
  Say("noise of a plugin that is asked");
  take(to, kDescription, std::strlen(kDescription));
  return 0;
}

int Traits(const rockyard_values*, rockyard_take_text take, void* to, rockyard_error*) {
  take(to, kTraits, std::strlen(kTraits));
  return 0;
}

int Create(const rockyard_values* values, const rockyard_setup*, void** navigator,
           rockyard_error*) {
  const rockyard_value* value = values->values;
  if (value[kMakesNone].integer != 0) return 0;
  auto* plain = new (std::nothrow) Plain{};
  plain->decision.status = static_cast<int32_t>(value[kStatus].integer);
  plain->decision.motion = static_cast<int32_t>(value[kMotion].integer);
  plain->decision.direction = static_cast<int32_t>(value[kDirection].integer);
  plain->decision.look = static_cast<int32_t>(value[kLook].integer);
  plain->decision.speed_share = value[kSpeed].real;
  plain->decision.work_ops = value[kOps].real;
  plain->fails = value[kFails].integer != 0;
  *navigator = plain;
  return 0;
}

int Decide(void* navigator, const rockyard_input*, rockyard_decision* decision,
           rockyard_error* error) {
  auto* plain = static_cast<Plain*>(navigator);
  plain->asked += 1.0;
  *decision = plain->decision;
  if (!plain->fails) return 0;
  // A text that fills its place, without an end.
  std::memset(error->text, 'x', sizeof error->text);
  return 1;
}

int OnJump(void*, int, const rockyard_pose*, const rockyard_pose*, rockyard_error*) { return 0; }
int SetGoal(void*, const rockyard_place*, int, rockyard_error*) { return 0; }

int OwnValues(void* navigator, double* values, size_t count, rockyard_error*) {
  if (count == 1) values[0] = static_cast<Plain*>(navigator)->asked;
  return 0;
}

int Overlay(void*, rockyard_overlay*, rockyard_error*) { return 0; }
void Destroy(void* navigator) { delete static_cast<Plain*>(navigator); }

const rockyard_navigator_type kType{Describe, Traits,    Create,  Decide, OnJump,
                                    SetGoal,  OwnValues, Overlay, Destroy};
const rockyard_navigator_type* const kTypes[] = {&kType};
const rockyard_plugin_info kInfo{ROCKYARD_PLUGIN_ABI, 0, kTypes, 1, nullptr, 0, nullptr, 0};

}  // namespace

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return kLoaded ? &kInfo : nullptr; }
