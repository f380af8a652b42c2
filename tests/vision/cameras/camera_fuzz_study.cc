// Gives the readers of camera files many damaged ones (core/fuzz_study.h).
#include "core/fuzz_study.h"
#include "vision/cameras/mutated_cameras.h"

int main(int count, char** arguments) {
  using namespace rockyard::vision;
  const std::vector<CameraSeed> seeds = CameraSeeds();
  return rockyard::core::FuzzStudy(count, arguments, [&](auto seed, auto number) {
    const CameraSeed file = MutatedCamera(seeds, seed, number);
    return rockyard::core::OfReader(file.name, JudgeCamera(file));
  });
}
