#include "campaign/odometry/pose_text.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <iterator>

#include "core/check.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace rockyard::campaign {
namespace {

using math::Transform;

constexpr std::size_t kKittiNumbers = 12;
constexpr std::size_t kTumNumbers = 8;
constexpr double kNoRotation = 1e-3;

struct NumberLine {
  int line = 1;                 // from 1
  std::vector<double> numbers;  // finite
};

[[noreturn]] void FailAtLine(const std::filesystem::path& path, int line, const std::string& reason,
                             const std::string& suggestion) {
  throw core::UserError(fmt::format("{}: line {}", path.string(), line), reason, suggestion);
}

// Returns the rotation nearest to a matrix that is one but for the digits of a file.
Eigen::Matrix3d ExactRotation(const Eigen::Matrix3d& near) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(near, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Transform KittiPose(const std::filesystem::path& path, const NumberLine& line) {
  Eigen::Matrix<double, 3, 4> rows;
  std::size_t next = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) rows(i, j) = line.numbers[next++];
  }
  const Eigen::Matrix3d linear = rows.leftCols<3>();
  const double off = (linear.transpose() * linear - Eigen::Matrix3d::Identity()).norm();
  if (!(off < kNoRotation && linear.determinant() > 0.0)) {
    FailAtLine(path, line.line, "holds no rotation in its first three columns",
               "give the rows of [R p], twelve numbers, with a right-handed R");
  }
  Transform pose = Transform::Identity();
  pose.linear() = ExactRotation(linear);
  pose.translation() = rows.col(3);
  return pose;
}

Transform TumPose(const std::filesystem::path& path, const NumberLine& line) {
  const std::vector<double>& n = line.numbers;
  const Eigen::Quaterniond q(n[7], n[4], n[5], n[6]);
  if (!(std::abs(q.norm() - 1.0) < kNoRotation)) {
    FailAtLine(path, line.line, "holds no unit quaternion",
               "give \"time x y z qx qy qz qw\", the quaternion of length 1");
  }
  Transform pose = Transform::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = math::Vector3(n[1], n[2], n[3]);
  return pose;
}

void CheckGrowing(const std::filesystem::path& path, const std::vector<NumberLine>& lines) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].numbers[0] > lines[i - 1].numbers[0]) continue;
    FailAtLine(path, lines[i].line, "its time is not later than that of the line before",
               "sort the lines by time, each time once");
  }
}

// Reads a text file of at most 64 MB whose lines are numbers; lines that are empty or begin with #
// are left out. Throws core::UserError with the line: a word that is no finite number; no line with
// numbers at all; a file that cannot be read. `kind` says what to give instead: "a file of poses".
std::vector<NumberLine> ReadNumberLines(const std::filesystem::path& path, std::string_view kind) {
  const std::string text = core::ReadTextFile(path, kLargestText, kind);
  std::vector<NumberLine> lines;
  int number = 0;
  for (const std::string_view line : LinesOf(text)) {
    ++number;
    const std::vector<std::string_view> words = WordsOf(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    NumberLine& read = lines.emplace_back();
    read.line = number;
    for (const std::string_view word : words) {
      if (!ParseNumber(word, read.numbers.emplace_back())) {
        throw core::UserError(fmt::format("{}: line {}", path.string(), number),
                              fmt::format("\"{}\" is no finite number", word.substr(0, 40)),
                              fmt::format("give {}", kind));
      }
    }
  }
  if (lines.empty()) {
    throw core::UserError(path.string(), "holds no numbers", fmt::format("give {}", kind));
  }
  return lines;
}

}  // namespace

std::string KittiPoses(std::span<const Transform> poses) {
  std::string text;
  for (const Transform& pose : poses) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        fmt::format_to(std::back_inserter(text), "{}{}", pose(i, j), i == 2 && j == 3 ? '\n' : ' ');
      }
    }
  }
  return text;
}

std::string TumPoses(std::span<const Transform> poses, std::span<const double> times_s) {
  EXPECT(poses.size() == times_s.size());
  std::string text = "# time x y z qx qy qz qw\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const math::Vector3 p = poses[i].translation();
    const Eigen::Quaterniond q(poses[i].linear());
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {}\n", times_s[i], p.x(), p.y(),
                   p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::string TimesText(std::span<const double> times_s) {
  std::string text;
  for (const double time_s : times_s) fmt::format_to(std::back_inserter(text), "{}\n", time_s);
  return text;
}

PoseFile ReadPoses(const std::filesystem::path& path) {
  const std::vector<NumberLine> lines = ReadNumberLines(path, "a file of poses");
  const std::size_t count = lines.front().numbers.size();
  PoseFile file;
  for (const NumberLine& line : lines) {
    if (line.numbers.size() != count || (count != kKittiNumbers && count != kTumNumbers)) {
      FailAtLine(path, line.line, fmt::format("has {} numbers", line.numbers.size()),
                 "give twelve in every line (KITTI: the rows of [R p]) or eight (TUM: time x y z "
                 "qx qy qz qw)");
    }
    file.poses.push_back(count == kKittiNumbers ? KittiPose(path, line) : TumPose(path, line));
  }
  if (count == kTumNumbers) {
    CheckGrowing(path, lines);
    file.times_s.emplace();
    for (const NumberLine& line : lines) file.times_s->push_back(line.numbers[0]);
  }
  return file;
}

std::vector<double> ReadTimes(const std::filesystem::path& path) {
  const std::vector<NumberLine> lines = ReadNumberLines(path, "a file of times");
  std::vector<double> times_s;
  for (const NumberLine& line : lines) {
    if (line.numbers.size() != 1) {
      FailAtLine(path, line.line, fmt::format("has {} numbers", line.numbers.size()),
                 "give one time in every line, s");
    }
    times_s.push_back(line.numbers[0]);
  }
  CheckGrowing(path, lines);
  return times_s;
}

std::vector<std::string_view> WordsOf(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r,";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kBetween);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBetween, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBetween, end);
  }
  return words;
}

bool ParseNumber(std::string_view word, double& number) {
  const std::optional<double> read = core::FiniteNumber(word);
  if (read) number = *read;
  return read.has_value();
}

std::vector<std::string_view> LinesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace rockyard::campaign
