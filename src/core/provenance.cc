#include "core/provenance.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <thread>

#include "core/build_commit.h"
#include "core/build_info.h"

namespace rockyard::core {
namespace {

std::string HostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string CpuModel() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

// Levels of the x86-64 psABI, by the features that tell them apart.
std::string CpuLevel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return "x86-64-v4";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2")) {
    return "x86-64-v3";
  }
  return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64-v1";
#else
  return kBuildProcessor;
#endif
}

}  // namespace

Provenance CurrentProvenance() {
  Provenance provenance;
  provenance.version = kBuildVersion;
  provenance.commit = kBuildCommit;
  provenance.compiler = kBuildCompiler;
  provenance.flags = kBuildFlags;
  provenance.build_type = kBuildType;
  provenance.host = HostName();
  provenance.cpu_model = CpuModel();
  provenance.cpu_level = CpuLevel();
  provenance.cpu_threads = static_cast<int>(std::thread::hardware_concurrency());
  return provenance;
}

std::string VersionLine() {
  return fmt::format("rockyard {} (commit {}, {}, {})", kBuildVersion, kBuildCommit, kBuildCompiler,
                     kBuildType);
}

}  // namespace rockyard::core
