// What made a result: source, compiler and machine. Stored runs, traces, reports and output folders
// keep it, and `rockyard --version` tells it.
#pragma once

#include <string>

namespace rockyard::core {

struct Provenance {
  std::string version;     // of rockyard, "0.1.0"
  std::string commit;      // of the sources when they were built, "-dirty" where they had changes;
                           // "unknown" outside git
  std::string compiler;    // "GNU 12.2.0"
  std::string flags;       // of the build type, with the floating-point options; modules in which
                           // drives spend no time have -O1 (SELDOM_RUN in CMake)
  std::string build_type;  // "Release"
  std::string host;        // name of this machine
  std::string cpu_model;
  std::string cpu_level;  // feature level of the processor, "x86-64-v3": tells why it was quick
  int cpu_threads = 1;    // that this machine runs at once
};

// Returns the provenance of this program on this machine. Nothing in a trial record depends on it.
Provenance CurrentProvenance();

// Returns "rockyard 0.1.0 (commit 0123456789ab, GNU 12.2.0, Release)".
std::string VersionLine();

}  // namespace rockyard::core
