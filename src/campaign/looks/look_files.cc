#include "campaign/looks/look_files.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "campaign/looks/look_pictures.h"
#include "campaign/looks/picture_lines.h"
#include "campaign/stereo/stereo_products.h"
#include "image_files/png_file.h"
#include "report/atomic_file.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

using image_files::ColouredPoint;
using image_files::Picture;
using messages::LookDirection;

class FolderWriter {
 public:
  FolderWriter(const fs::path& folder, LookDirection direction)
      : folder_(folder), cameras_(CamerasOf(direction)) {}

  template <typename Value>
  void Png(std::string_view name, const vision::Image<Value>& picture, std::string what) {
    // A PNG file has a pixel at least.
    const vision::Image<Value> pixel(1, 1);
    Write(fmt::format("{}.png", name), image_files::EncodePng(picture.empty() ? pixel : picture),
          std::move(what));
  }

  void Ply(const std::vector<ColouredPoint>& points, std::string what) {
    Write("cloud.ply", image_files::EncodePly(points, "rover frame R, metres"), std::move(what));
  }

  std::vector<LookFile> files() && { return std::move(files_); }

 private:
  void Write(std::string_view name, std::string_view bytes, std::string what) {
    LookFile file{fmt::format("{}-{}", cameras_, name), std::move(what)};
    report::WriteFileAtomically(folder_ / file.name, bytes);
    files_.push_back(std::move(file));
  }

  const fs::path& folder_;
  std::string_view cameras_;
  std::vector<LookFile> files_;
};

Picture ToSee(const Picture& picture) {
  return Enlarged(picture, FactorToSee(picture.width(), picture.height()));
}

std::string RangeText(const vision::CorrelatorParams& range) {
  return fmt::format("disparities from {} px, violet, to {} px, yellow; black where there is none",
                     range.min_disparity_px, range.min_disparity_px + range.disparities - 1);
}

void WriteElevations(const ElevationImage& image, const std::optional<HeightSpan>& span,
                     FolderWriter& writer) {
  std::string what = "the points from above: there are none";
  if (span) {
    what = fmt::format(
        "the points from above, the rover below, {:.2f} m a cell: {:.2f} m, violet, to {:.2f} m, "
        "yellow",
        image.grid.cell_m, span->low_m, span->high_m);
  }
  writer.Png("elevation", ToSee(ElevationPicture(image.heights_m)), std::move(what));
}

std::string PointsText(std::size_t points) { return fmt::format("{} points in R, m", points); }

std::vector<LookFile> WriteLook(const fs::path& folder, const CapturedLook& look,
                                const messages::NavigationView& view) {
  FolderWriter writer(folder, look.cloud.direction);
  writer.Png("left", look.sight.left,
             fmt::format("left image of look {}, reduced and aligned as it was matched, {} x {}",
                         look.cloud.number, look.sight.left.width(), look.sight.left.height()));
  writer.Png("grid", GridPicture(look, view),
             "the same in muted grey with the map in colours of goodness");
  writer.Png("disparity", ToSee(DisparityPicture(look.sight.disparities, look.matching.correlator)),
             RangeText(look.matching.correlator));
  const ElevationImage elevations = ElevationsOf(look.cloud);
  WriteElevations(elevations, HeightSpanOf(elevations.heights_m), writer);
  writer.Ply(GreyPoints(look), PointsText(look.cloud.points_R.size()));
  return std::move(writer).files();
}

}  // namespace

std::vector<LookFile> WriteLookFiles(const fs::path& folder, std::span<const CapturedLook> looks,
                                     const messages::NavigationView& view) {
  std::vector<LookFile> files;
  for (const CapturedLook& look : looks) {
    for (LookFile& file : WriteLook(folder, look, view)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<LookFile> WriteCloudFiles(const fs::path& folder, const messages::PointCloud& cloud) {
  FolderWriter writer(folder, cloud.direction);
  const ElevationImage elevations = ElevationsOf(cloud);
  const std::optional<HeightSpan> span = HeightSpanOf(elevations.heights_m);
  WriteElevations(elevations, span, writer);
  writer.Ply(HeightPoints(cloud, span.value_or(HeightSpan{})), PointsText(cloud.points_R.size()));
  return std::move(writer).files();
}

}  // namespace rockyard::campaign
