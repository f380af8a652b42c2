// Which files are the pairs of images of a sequence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rockyard::campaign {

struct SequencePair {
  std::filesystem::path left;
  std::filesystem::path right;
  std::optional<double> time_s;
};

struct ImageSequence {
  std::string layout;  // in words: "folders left and right"
  std::vector<SequencePair> pairs;
  // Of a folder: its calib.txt, left_free.png and right_free.png; empty where there are none.
  std::filesystem::path calibration;
  std::filesystem::path left_free;
  std::filesystem::path right_free;
};

// The pairs of a sequence in their order. `path` is one of
//   a folder with two folders of images: left and right, image_0 and image_1 (KITTI), image_l and
//     image_r; pairs have the same name, in natural order (2 before 10); with times.txt, a time (s)
//     a line, where there is one;
//   a folder with mav0, or mav0 itself (EuRoC): cam0/data.csv and cam1/data.csv list times (ns) and
//     names in data; pairs have the same time;
//   a text file with the two paths of a pair a line, relative to its folder, and a time (s) after
//     them where there is one.
// Throws core::UserError: none of these; an empty folder; images without a partner, by name, all of
// them up to twenty; a time or a path that is none; fewer times than pairs or more; no pair.
// Images are not opened.
ImageSequence FindSequence(const std::filesystem::path& path);

// Whether the digits in names count as numbers: "a2" before "a10"; equal numbers by their texts.
bool NaturallyBefore(std::string_view a, std::string_view b);

}  // namespace rockyard::campaign
