// Gives the readers of image files many damaged ones (core/fuzz_study.h).
#include "core/fuzz_study.h"

#include "core/test_folder.h"
#include "image_files/mutated_files.h"

int main(int count, char** arguments) {
  using namespace rockyard::image_files;
  const rockyard::core::TestFolder folder;
  const std::vector<SeedFile> files = SeedFiles(folder.path());
  return rockyard::core::FuzzStudy(count, arguments, [&](auto seed, auto number) {
    const SeedFile file = MutatedFile(files, seed, number);
    return rockyard::core::OfReader(file.name, JudgeFile(file, folder.path()));
  });
}
