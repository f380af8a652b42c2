// A plugin whose description ends too early.
#include "plugin/abi.h"

namespace {

int Describe(rockyard_take_text take, void* to, rockyard_error*) {
  take(to, "{\"name\": \"broken", 15);
  return 0;
}

const rockyard_navigator_type kType{Describe, nullptr, nullptr, nullptr, nullptr,
                                    nullptr,  nullptr, nullptr, nullptr};
const rockyard_navigator_type* const kTypes[] = {&kType};
const rockyard_plugin_info kInfo{ROCKYARD_PLUGIN_ABI, 0, kTypes, 1, nullptr, 0, nullptr, 0};

}  // namespace

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return &kInfo; }
