// A plugin that crashes as it is loaded.
#include <cstdlib>

#include "plugin/abi.h"

namespace {

const rockyard_plugin_info* Crash() { std::abort(); }
const rockyard_plugin_info* const kInfo = Crash();

}  // namespace

extern "C" const rockyard_plugin_info* rockyard_plugin(void) { return kInfo; }
