#include "campaign/calibrate/calibrate_input.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>

#include "core/error.h"
#include "image_files/luminance.h"
#include "image_files/read_image.h"
#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/target_file.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

using core::Problem;

void CheckCounts(const CalibrateRequest& request, const vision::Target& target) {
  const std::size_t images = request.images.size();
  if (!request.right.empty() && request.right.size() != images) {
    throw core::UserError(
        "--right",
        fmt::format("names {} images, the left camera has {}", request.right.size(), images),
        "give the right image of each left one, in the same order");
  }
  if (!target.surveyed_X_AT.empty() && target.surveyed_X_AT.size() != images) {
    throw core::UserError(
        request.target.string(),
        fmt::format("has {} poses, there are {} images", target.surveyed_X_AT.size(), images),
        "give one pose for each image, in their order, or leave poses out");
  }
  std::set<fs::path> seen;
  for (const auto* paths : {&request.images, &request.right}) {
    for (const fs::path& path : *paths) {
      if (seen.insert(path).second) continue;
      throw core::UserError(path.string(), "is named twice",
                            "give each image once: it adds nothing the second time");
    }
  }
}

// Reads one camera's images; what is wrong with them goes to `problems`.
class CornerReader {
 public:
  CornerReader(const CalibrateRequest& request, CalibrateInput& input,
               std::vector<Problem>& problems)
      : request_(request), input_(input), problems_(problems) {}

  void Read(const std::vector<fs::path>& paths) {
    input_.data.corners.emplace_back();
    input_.read.emplace_back();
    for (const fs::path& path : paths) {
      try {
        ReadOne(path);
      } catch (const core::UserError& error) {
        problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
      }
    }
  }

 private:
  void ReadOne(const fs::path& path) {
    const image_files::RawImage raw = image_files::ReadImage(path);
    const image_files::GrayConversion gray = image_files::ToGray(raw, {.white = request_.white});
    input_.read.back().push_back(
        fmt::format("{}; {}", image_files::DescribeImage(raw), gray.what_was_done));
    if (input_.advice.empty()) input_.advice = gray.advice;
    CheckSize(path, gray.image);
    core::Result<std::vector<vision::Pixel>> corners =
        vision::FindChessboard(gray.image, input_.data.board);
    if (!corners.ok()) {
      Problem problem = corners.problems().front();
      throw core::UserError(path.string(), problem.reason,
                            gray.advice.empty() ? problem.suggestion : gray.advice);
    }
    input_.data.corners.back().push_back(*corners);
  }

  void CheckSize(const fs::path& path, const vision::GrayImage& image) {
    vision::ImageSize& size = input_.data.size;
    if (size.columns == 0) {
      size = {image.width(), image.height()};
      first_ = path;
    }
    if (image.width() == size.columns && image.height() == size.rows) return;
    throw core::UserError(path.string(),
                          fmt::format("has {} x {} pixels, {} has {} x {}", image.width(),
                                      image.height(), first_.string(), size.columns, size.rows),
                          "give images of one size, as the cameras took them");
  }

  const CalibrateRequest& request_;
  CalibrateInput& input_;
  std::vector<Problem>& problems_;
  fs::path first_;
};

}  // namespace

CalibrateInput ReadCalibrateInput(const CalibrateRequest& request) {
  const vision::Target target = vision::LoadTarget(request.target);
  CheckCounts(request, target);
  CalibrateInput input;
  input.data.board = target.board;
  input.data.surveyed_X_AT = target.surveyed_X_AT;
  std::vector<Problem> problems;
  CornerReader reader(request, input, problems);
  reader.Read(request.images);
  if (!request.right.empty()) reader.Read(request.right);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return input;
}

}  // namespace rockyard::campaign
