// A painted pair of the coloured cylinder as files, whole and damaged.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/cylinder/find_cylinder.h"
#include "image_files/mutated_files.h"

namespace rockyard::campaign {

// Writes left.png, right.png and cameras.json of a cylinder 2 m away at 30 deg into the folder.
CylinderRequest WritePaintedPair(const std::filesystem::path& folder);

enum class CylinderOutcome { kFound, kMissed, kRefused, kFailed };

struct CylinderVerdict {
  CylinderOutcome outcome = CylinderOutcome::kFailed;
  std::string what;  // a miss, a refusal, or what failed
};

// Damages the left or the right image (PNG or PPM) as a function of seed and number, and looks for
// the cylinder with both finders. Refusals and misses without words have failed, and so has a pose
// more than 10 deg or 10 % off that the robust finder gives.
class DamagedPairs {
 public:
  explicit DamagedPairs(const std::filesystem::path& folder);

  CylinderVerdict Judge(std::uint64_t seed, std::uint32_t number) const;

 private:
  std::filesystem::path folder_;
  CylinderRequest request_;
  std::array<std::vector<image_files::SeedFile>, 2> seeds_;  // of the left and of the right eye
};

}  // namespace rockyard::campaign
