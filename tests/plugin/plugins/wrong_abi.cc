// A plugin of another version of the interface: nothing else of it may be looked at.
#include <cstdint>

#include "plugin/abi.h"

extern "C" const rockyard_plugin_info* rockyard_plugin(void) {
  static const rockyard_plugin_info info{
      ROCKYARD_PLUGIN_ABI + 1,
      0,
      reinterpret_cast<const rockyard_navigator_type* const*>(std::uintptr_t{8}),
      1,
      nullptr,
      0,
      nullptr,
      0};
  return &info;
}
