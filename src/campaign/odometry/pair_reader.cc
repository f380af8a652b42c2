#include "campaign/odometry/pair_reader.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "campaign/odometry/pose_text.h"
#include "core/error.h"
#include "core/files.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/rectification.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

std::string PixelsText(const vision::ImageSize& size) {
  return fmt::format("{} x {} pixels", size.columns, size.rows);
}

vision::GrayImage GrayOf(const fs::path& path, std::optional<int> white) {
  return image_files::ToGray(image_files::ReadImage(path), {.white = white}).image;
}

void CheckSizes(const fs::path& path, const vision::GrayImage& image,
                const vision::ImageSize& size) {
  const vision::ImageSize is{image.width(), image.height()};
  if (is == size) return;
  throw core::UserError(
      path.string(),
      fmt::format("has {}, the first image of the sequence {}", PixelsText(is), PixelsText(size)),
      "give images of one size");
}

vision::CameraPair CamerasOf(const OdometryRequest& request, const ImageSequence& sequence,
                             const vision::ImageSize& size) {
  if (request.cameras.empty()) {
    if (!sequence.calibration.empty()) return LoadKittiCalibration(sequence.calibration, size);
    throw core::UserError("--cameras", "is missing",
                          "name a file with the cameras of both images (src/vision/README.md)");
  }
  vision::CameraPair pair = vision::LoadCameraPair(request.cameras);
  for (const auto& [eye, camera] : {std::pair{"left", &pair.left}, {"right", &pair.right}}) {
    if (camera->size == size) continue;
    throw core::UserError(request.cameras.string(),
                          fmt::format("{} is a camera of {}, the images have {}", eye,
                                      PixelsText(camera->size), PixelsText(size)),
                          "give the cameras of these very images");
  }
  return pair;
}

// Reads the mask of free pixels; all are free where there is no file.
vision::Image<std::uint8_t> MaskOf(const fs::path& path, const vision::ImageSize& size) {
  if (path.empty()) return {size.columns, size.rows, 1};
  vision::Image<std::uint8_t> mask = GrayOf(path, std::nullopt);
  CheckSizes(path, mask, size);
  for (std::uint8_t& pixel : mask.values()) pixel = pixel == 0 ? 0 : 1;
  return mask;
}

// Aligns the eyes. Where the cameras cannot be aligned, the problems name the file too.
perception::AlignedEyes EyesOf(const fs::path& file, const vision::StereoRig& rig) {
  try {
    return {rig, 0};
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      problem.path = fmt::format("{}: {}", file.string(), problem.path);
    }
    throw core::UserError(std::move(problems));
  }
}

constexpr std::size_t kNumbers = 12;
constexpr const char* kForm = "give \"P0: \" and \"P1: \" with the twelve numbers of each camera";

using Projection = Eigen::Matrix<double, 3, 4>;

// Returns the projection on a line; nothing where the line is none.
std::optional<Projection> ProjectionOf(std::string_view line) {
  std::vector<std::string_view> words = WordsOf(line);
  if (!words.empty() && words.front().ends_with(':')) {
    if (words.front() != "P0:" && words.front() != "P1:") return std::nullopt;
    words.erase(words.begin());
  }
  if (words.size() != kNumbers) return std::nullopt;
  Projection P;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (!ParseNumber(words[i], P(static_cast<int>(i / 4), static_cast<int>(i % 4)))) {
      return std::nullopt;
    }
  }
  return P;
}

vision::CameraModel CameraOfProjection(const std::filesystem::path& path, const Projection& P,
                                       const vision::ImageSize& size) {
  const Eigen::Matrix3d M = P.leftCols<3>();
  if (M.row(2) != Eigen::RowVector3d(0.0, 0.0, 1.0) || !(M(0, 0) > 0.0) || !(M(1, 1) > 0.0)) {
    throw core::UserError(path.string(), "holds a projection that is none of a rectified camera",
                          kForm);
  }
  vision::Cahv camera;
  camera.H = M.row(0).transpose();
  camera.V = M.row(1).transpose();
  camera.A = M.row(2).transpose();
  camera.C = -M.inverse() * P.col(3);
  return {camera, size};
}

}  // namespace

PairReader::PairReader(const OdometryRequest& request, const ImageSequence& sequence)
    : white_(request.white) {
  const SequencePair& first = sequence.pairs.front();
  const image_files::RawImage raw = image_files::ReadImage(first.left);
  description_ = image_files::DescribeImage(raw);
  advice_ = image_files::ToGray(raw, {.white = white_}).advice;
  size_ = {raw.width(), raw.height()};
  const GrayPair images = Read(first);
  if (images.left == images.right) {
    throw core::UserError(first.right.string(), "shows the same as the left image, pixel by pixel",
                          "give the images of the other eye");
  }
  const vision::CameraPair cameras = CamerasOf(request, sequence, size_);
  resampled_ = !vision::AlignedPair(cameras.left, cameras.right).has_value();
  eyes_ = EyesOf(request.cameras.empty() ? sequence.calibration : request.cameras,
                 {cameras.left, cameras.right, MaskOf(sequence.left_free, size_),
                  MaskOf(sequence.right_free, size_)});
}

GrayPair PairReader::Read(const SequencePair& pair) const {
  GrayPair images{GrayOf(pair.left, white_), GrayOf(pair.right, white_)};
  CheckSizes(pair.left, images.left, size_);
  CheckSizes(pair.right, images.right, size_);
  return images;
}

vision::AlignedImages PairReader::Align(const GrayPair& images) const {
  return {eyes_->Left(images.left), eyes_->Right(images.right)};
}

vision::CameraPair LoadKittiCalibration(const std::filesystem::path& path,
                                        const vision::ImageSize& size) {
  const std::string text = core::ReadTextFile(path, kLargestText, "KITTI's calib.txt");
  std::vector<Projection> found;
  for (const std::string_view line : LinesOf(text)) {
    const auto projection = ProjectionOf(line);
    if (projection && found.size() < 2) found.push_back(*projection);
  }
  if (found.size() < 2) {
    throw core::UserError(
        path.string(), fmt::format("holds {} projections of cameras 0 and 1", found.size()), kForm);
  }
  return {CameraOfProjection(path, found[0], size), CameraOfProjection(path, found[1], size)};
}

namespace {

constexpr std::size_t kToldProblems = 20;
constexpr double kNanosecond_s = 1e-9;
constexpr const char* kWays =
    "give a folder with left and right, image_0 and image_1 or image_l and image_r, one with mav0, "
    "or a text file with two paths a line";

constexpr std::array<std::pair<const char*, const char*>, 3> kFolderNames{
    {{"left", "right"}, {"image_0", "image_1"}, {"image_l", "image_r"}}};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    return NaturallyBefore(a, b);
  }
};

// Takes the digits that a text begins with, and returns them without leading zeros.
std::string_view LeadingNumber(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && IsDigit(text[end])) ++end;
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

void ThrowAll(std::vector<core::Problem> problems) {
  if (problems.empty()) return;
  if (problems.size() > kToldProblems) {
    const std::size_t more = problems.size() - kToldProblems;
    problems.resize(kToldProblems);
    problems.back().reason += fmt::format("; and {} more like it", more);
  }
  throw core::UserError(std::move(problems));
}

fs::path IfThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) ? path : fs::path();
}

// Returns the names of the files in a folder but for hidden ones.
std::set<std::string, NaturalOrder> NamesIn(const fs::path& folder) {
  std::set<std::string, NaturalOrder> names;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) {
    throw core::UserError(folder.string(), "cannot be read: " + error.message(), kWays);
  }
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() && !name.starts_with('.')) names.insert(name);
  }
  if (names.empty()) {
    throw core::UserError(folder.string(), "holds no images", "put the images of one eye into it");
  }
  return names;
}

std::vector<SequencePair> PairsByName(const fs::path& left, const fs::path& right) {
  const auto lefts = NamesIn(left);
  const auto rights = NamesIn(right);
  std::vector<SequencePair> pairs;
  std::vector<core::Problem> problems;
  const auto alone = [&](const fs::path& image, const fs::path& other) {
    problems.push_back({image.string(), fmt::format("has no partner {}", other.string()),
                        "give both images of a pair the same name, or remove this one"});
  };
  for (const std::string& name : lefts) {
    if (rights.contains(name)) {
      pairs.push_back({left / name, right / name, std::nullopt});
    } else {
      alone(left / name, right / name);
    }
  }
  for (const std::string& name : rights) {
    if (!lefts.contains(name)) alone(right / name, left / name);
  }
  ThrowAll(std::move(problems));
  return pairs;
}

ImageSequence SequenceOfFolders(const fs::path& folder, const char* left, const char* right) {
  ImageSequence sequence;
  sequence.layout = fmt::format("folders {} and {}", left, right);
  sequence.pairs = PairsByName(folder / left, folder / right);
  sequence.calibration = IfThere(folder / "calib.txt");
  sequence.left_free = IfThere(folder / "left_free.png");
  sequence.right_free = IfThere(folder / "right_free.png");
  const fs::path times_file = IfThere(folder / "times.txt");
  if (times_file.empty()) return sequence;
  const std::vector<double> times_s = ReadTimes(times_file);
  if (times_s.size() != sequence.pairs.size()) {
    throw core::UserError(
        times_file.string(),
        fmt::format("has {} times, there are {} pairs", times_s.size(), sequence.pairs.size()),
        "give one time a pair, or remove the file");
  }
  for (std::size_t i = 0; i < times_s.size(); ++i) sequence.pairs[i].time_s = times_s[i];
  return sequence;
}

// Returns the paths of the images of a camera by their times, ns.
std::map<std::int64_t, fs::path> ListedImages(const fs::path& camera) {
  const fs::path list = camera / "data.csv";
  const std::string text = core::ReadTextFile(list, kLargestText, "EuRoC's list of images");
  std::map<std::int64_t, fs::path> images;
  int number = 0;
  for (const std::string_view line : LinesOf(text)) {
    ++number;
    const std::vector<std::string_view> words = WordsOf(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    double time_ns = 0.0;
    constexpr double kMost_ns = 9e18;  // of 64 bits
    if (words.size() != 2 || !ParseNumber(words[0], time_ns) || std::abs(time_ns) > kMost_ns) {
      throw core::UserError(fmt::format("{}: line {}", list.string(), number),
                            "is no time and name of an image",
                            "give \"TIME_NS,NAME\", the name of a file in data");
    }
    images[static_cast<std::int64_t>(time_ns)] = camera / "data" / std::string(words[1]);
  }
  return images;
}

ImageSequence EurocSequence(const fs::path& mav) {
  const auto lefts = ListedImages(mav / "cam0");
  const auto rights = ListedImages(mav / "cam1");
  ImageSequence sequence;
  sequence.layout = "EuRoC, cam0 and cam1";
  std::vector<core::Problem> problems;
  const auto alone = [&](std::int64_t time_ns, const fs::path& image, const char* other) {
    problems.push_back({image.string(),
                        fmt::format("has no partner of time {} in {}", time_ns, other),
                        "list both images of a pair at the same time, or remove its line"});
  };
  for (const auto& [time_ns, left] : lefts) {
    const auto right = rights.find(time_ns);
    if (right == rights.end()) {
      alone(time_ns, left, "cam1/data.csv");
    } else {
      sequence.pairs.push_back({left, right->second, kNanosecond_s * static_cast<double>(time_ns)});
    }
  }
  for (const auto& [time_ns, right] : rights) {
    if (!lefts.contains(time_ns)) alone(time_ns, right, "cam0/data.csv");
  }
  ThrowAll(std::move(problems));
  return sequence;
}

ImageSequence ListedSequence(const fs::path& list) {
  const std::string text = core::ReadTextFile(list, kLargestText, "a list of images");
  ImageSequence sequence;
  sequence.layout = "a list of files";
  int number = 0;
  for (const std::string_view line : LinesOf(text)) {
    ++number;
    const std::vector<std::string_view> words = WordsOf(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    double time_s = 0.0;
    if (words.size() < 2 || words.size() > 3 ||
        (words.size() == 3 && !ParseNumber(words[2], time_s))) {
      throw core::UserError(fmt::format("{}: line {}", list.string(), number),
                            "is no pair of images", "give \"LEFT RIGHT\" or \"LEFT RIGHT TIME_S\"");
    }
    SequencePair& pair = sequence.pairs.emplace_back();
    pair.left = list.parent_path() / std::string(words[0]);
    pair.right = list.parent_path() / std::string(words[1]);
    if (words.size() == 3) pair.time_s = time_s;
  }
  return sequence;
}

ImageSequence SequenceIn(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw core::UserError(path.string(), "does not exist", kWays);
  }
  if (!fs::is_directory(path, error)) return ListedSequence(path);
  for (const auto& [left, right] : kFolderNames) {
    const bool has_left = fs::is_directory(path / left, error);
    const bool has_right = fs::is_directory(path / right, error);
    if (has_left && has_right) return SequenceOfFolders(path, left, right);
    if (has_left != has_right) {
      throw core::UserError(path.string(),
                            fmt::format("has a folder {} but none {}", has_left ? left : right,
                                        has_left ? right : left),
                            "put the images of the other eye beside it");
    }
  }
  if (fs::is_directory(path / "mav0", error)) return EurocSequence(path / "mav0");
  if (fs::is_directory(path / "cam0", error)) return EurocSequence(path);
  throw core::UserError(path.string(), "is no sequence of image pairs that is known", kWays);
}

}  // namespace

bool NaturallyBefore(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (IsDigit(a.front()) && IsDigit(b.front())) {
      const std::string_view number_a = LeadingNumber(a);
      const std::string_view number_b = LeadingNumber(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;
}

ImageSequence FindSequence(const fs::path& path) {
  ImageSequence sequence = SequenceIn(path);
  if (sequence.pairs.empty()) {
    throw core::UserError(path.string(), "lists no pair of images", kWays);
  }
  return sequence;
}

}  // namespace rockyard::campaign
