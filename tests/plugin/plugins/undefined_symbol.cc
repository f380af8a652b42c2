// A plugin that lacks a function of another library.
#include "plugin/abi.h"

extern "C" const rockyard_plugin_info* NobodyHasThis(void);

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return NobodyHasThis(); }
