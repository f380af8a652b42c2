// Files of sites, mutated at random: read or refused, in bounded memory.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/files.h"
#include "fuzz/readers.h"

namespace rockyard {

// Returns the bytes with one to four places changed: flipped, replaced, cut off, doubled, or a
// number made larger.
inline std::string Mutated(std::string bytes, std::mt19937_64& random) {
  const auto below = [&](std::size_t bound) {
    return bound == 0 ? 0 : static_cast<std::size_t>(random() % bound);
  };
  constexpr std::size_t kMostChanges = 4;
  for (std::size_t changes = 1 + below(kMostChanges); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(1 + below(16), bytes.size() - at);
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ 1U << below(8));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.replace(at, length, bytes.substr(below(bytes.size()), length));
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        bytes.insert(digit == std::string::npos ? at : digit, "99");
      }
    }
  }
  return bytes;
}

// Reads `count` mutated files of the corpus of a reader. Returns how many were accepted.
inline int ReadMutated(std::string_view name, int count, std::uint64_t seed) {
  const auto reader = std::ranges::find(Readers(), name, &Reader::name);
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "tests/data/readers" / name;
  for (const auto& file : std::filesystem::directory_iterator(folder)) files.push_back(file.path());
  std::ranges::sort(files);
  std::mt19937_64 random(seed);
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    const std::string bytes =
        Mutated(core::ReadWholeFile(files[random() % files.size()], 1 << 20, "a corpus"), random);
    try {
      accepted += Accepts(*reader, bytes) ? 1 : 0;
    } catch (const std::exception& error) {
      ADD_FAILURE() << name << " " << seed << "/" << i << ": " << error.what();
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1L << 20) << "more than 1 GB";
  return accepted;
}

}  // namespace rockyard
