// A plugin that ends the process as it is loaded.
#include <unistd.h>

#include "plugin/abi.h"

namespace {

const rockyard_plugin_info* End() { _exit(3); }
const rockyard_plugin_info* const kInfo = End();

}  // namespace

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return kInfo; }
