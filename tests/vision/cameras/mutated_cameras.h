// Files of cameras with damage of many kinds, and a judge of what the readers make of them. Shared
// by the test of a few thousand cases and by the study of as many as are wanted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rockyard::vision {

struct CameraSeed {
  std::string name;
  std::string text;
  bool is_pair = false;
};

// Files in order of every model, JSON and text, one camera and two.
std::vector<CameraSeed> CameraSeeds();

// One of the seeds with one to six edits: bits, bytes, numbers replaced by odd ones, lines or
// pieces taken out, doubled, swapped, put in or taken from another seed, deep nesting, an end too
// early. A function of seed and number alone.
CameraSeed MutatedCamera(const std::vector<CameraSeed>& seeds, std::uint64_t seed,
                         std::uint32_t number);

enum class CameraOutcome { kRead, kRefused, kFailed };

struct CameraVerdict {
  CameraOutcome outcome = CameraOutcome::kFailed;
  std::string what;  // a refusal, or what failed
};

// What the readers say of a file: cameras within the limits, which project and back-project to
// finite numbers or to nothing and, written, read back to the same; or a refusal in words with a
// suggestion. Anything else has failed.
CameraVerdict JudgeCamera(const CameraSeed& file);

}  // namespace rockyard::vision
