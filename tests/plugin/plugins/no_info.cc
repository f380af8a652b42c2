// A plugin that hands over nothing.
#include "plugin/abi.h"

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return nullptr; }
