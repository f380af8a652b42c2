// Image files with damage of many kinds, and a judge of what the readers make of them. Shared with
// the tests of the finder of cylinders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::image_files {

struct SeedFile {
  std::string name;
  std::string bytes;
};

// A small file in order of every kind that is read. `folder` gets the pixels of the PDS4 label.
std::vector<SeedFile> SeedFiles(const std::filesystem::path& folder);

// One of the seeds with one to six edits: bits, bytes, numbers of a header, pieces taken out, put
// in, doubled or taken from another seed, an end too early. Half of the PNG files get the checksums
// that fit, and a third of them is made anew with any header and any rows. A function of seed and
// number alone.
SeedFile MutatedFile(const std::vector<SeedFile>& files, std::uint64_t seed, std::uint32_t number);

enum class Outcome { kRead, kRefused, kFailed };

struct Verdict {
  Outcome outcome = Outcome::kFailed;
  std::string what;  // a refusal, or what failed
};

// What the readers say of a file: an image within the limits and within its full scale, or a
// refusal in words with a suggestion. Anything else has failed. Planetary files are written to
// `folder`, as GDAL reads no bytes.
Verdict JudgeFile(const SeedFile& file, const std::filesystem::path& folder);

}  // namespace rockyard::image_files
