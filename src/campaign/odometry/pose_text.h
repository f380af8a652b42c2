// Files of poses and times, as the benchmarks of others write them; text files of numbers, line by
// line. `render --pairs` writes them, `vo` reads and writes them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/pose.h"

namespace rockyard::campaign {

// Returns a line for each pose: twelve numbers, the rows of [R p], of X_AB from the body B to A
// (the odometry benchmark of KITTI). The numbers read back to the same bits; ReadPoses makes
// rotations exact.
std::string KittiPoses(std::span<const math::Transform> poses);

// Returns a line for each pose: "time x y z qx qy qz qw" (TUM RGB-D benchmark), after a line of
// comment. There must be as many times (s) as poses.
std::string TumPoses(std::span<const math::Transform> poses, std::span<const double> times_s);

// Returns a line for each time, s.
std::string TimesText(std::span<const double> times_s);

// What a file of poses holds.
struct PoseFile {
  std::vector<math::Transform> poses;
  std::optional<std::vector<double>> times_s;  // of TUM's form; KITTI's has none
};

// Reads either form, which the count of numbers in a line tells; empty lines and lines that begin
// with # are passed over. Rotations are made exact, as files round them. Throws core::UserError
// with the line: another count of numbers, both forms, no number, a matrix or a quaternion that is
// no rotation (off by more than 1e-3), times that do not grow, no pose at all; also where the file
// cannot be read or is longer than 64 MB.
PoseFile ReadPoses(const std::filesystem::path& path);

// Reads times, as ReadPoses reads poses.
std::vector<double> ReadTimes(const std::filesystem::path& path);

// Returns the words of a line, which blanks, tabs, carriage returns or commas part.
std::vector<std::string_view> WordsOf(std::string_view line);

// Reads the finite number that all of a word is. Returns false where it is none.
bool ParseNumber(std::string_view word, double& number);

// Returns the lines of a text, without their ends.
std::vector<std::string_view> LinesOf(std::string_view text);

// The largest text file that is read, bytes.
inline constexpr std::size_t kLargestText = std::size_t{64} << 20;

}  // namespace rockyard::campaign
