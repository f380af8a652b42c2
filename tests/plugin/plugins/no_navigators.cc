// A plugin with neither navigators nor estimators.
#include "plugin/abi.h"

extern "C" const rockyard_plugin_info* rockyard_plugin(void) {
  static const rockyard_plugin_info info{
      ROCKYARD_PLUGIN_ABI, 0, nullptr, 0, nullptr, 0, nullptr, 0};
  return &info;
}
