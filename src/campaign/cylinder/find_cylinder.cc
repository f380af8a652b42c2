#include "campaign/cylinder/find_cylinder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "campaign/looks/look_pictures.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/provenance.h"
#include "image_files/png_file.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "math/angles.h"
#include "math/functions.h"
#include "report/result_table.h"
#include "vision/cameras/camera_file.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/published_finder.h"
#include "vision/cylinder/robust_finder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using image_files::Picture;
using image_files::Rgb;

CylinderParams CylinderParamsOf(const CylinderRequest& request) {
  core::JsonValue document = core::JsonValue::Object();
  for (const std::string& setting : request.settings) core::ApplyOverride(document, setting);
  CylinderParams params;
  core::ReadParams(document, params);
  return params;
}

std::string PixelsText(int columns, int rows) { return fmt::format("{} x {}", columns, rows); }

void CheckColourPair(const CylinderRequest& request, const vision::ColourImage& left,
                     const vision::ColourImage& right) {
  if (left.width() != right.width() || left.height() != right.height()) {
    throw core::UserError(
        request.right.string(),
        fmt::format("has {} pixels, the left image {}", PixelsText(right.width(), right.height()),
                    PixelsText(left.width(), left.height())),
        "give two images that were taken together, of one size");
  }
  if (left == right) {
    throw core::UserError(request.right.string(),
                          "shows the same as the left image, pixel by pixel",
                          "give the image of the other eye");
  }
}

void CheckCamera(const CylinderRequest& request, std::string_view eye,
                 const vision::CameraModel& camera, const vision::ColourImage& image) {
  if (camera.size.columns == image.width() && camera.size.rows == image.height()) return;
  throw core::UserError(request.cameras.string(),
                        fmt::format("{} is a camera of {} pixels, the image has {}", eye,
                                    PixelsText(camera.size.columns, camera.size.rows),
                                    PixelsText(image.width(), image.height())),
                        "give the cameras of these very images, not of larger or smaller ones");
}

std::uint8_t ToByte(std::uint16_t sample, int full_scale) {
  const int clipped = sample < full_scale ? sample : full_scale;
  return static_cast<std::uint8_t>((510 * clipped + full_scale) / (2 * full_scale));
}

// Refuses a cylinder that would lie in the image: cameras may be told in a frame whose z does not
// point upwards, and then the default axis is wrong.
void CheckAxis(const CylinderRequest& request, const vision::ColourPair& pair,
               const vision::ColourCylinder& cylinder) {
  constexpr double kMost_rad = math::DegToRad(60.0);
  const auto eyes = vision::GeometryOf(pair);
  if (!eyes) return;  // the finder says so
  const double off_rad = math::Acos(std::clamp(eyes->up_L.dot(cylinder.Axis_L()), -1.0, 1.0));
  if (off_rad <= kMost_rad) return;
  // Rounded to thousandths, and no coordinate -0.
  const Eigen::Array3d up = (1000.0 * eyes->up_L.array()).round() / 1000.0 + 0.0;
  throw core::UserError(
      "cylinder.axis",
      fmt::format("the cylinder would stand {:.0f} deg from upwards in the left image of {}",
                  math::RadToDeg(off_rad), request.cameras.string()),
      fmt::format("say which way is up in the cameras' frame; upwards in the image is "
                  "cylinder.axis=[{:.3f},{:.3f},{:.3f}]",
                  up.x(), up.y(), up.z()));
}

template <typename Enum>
std::string NameIn(Enum value) {
  return std::string(core::EnumNames<Enum>::kNames.at(static_cast<std::size_t>(value)));
}

JsonValue RegionJson(const vision::ColourRegion& region) {
  return report::ObjectTree(
      "role", NameIn(region.role), "left", region.left, "top", region.top, "right", region.right,
      "bottom", region.bottom, "pixels", region.pixels, "colour",
      region.colour ? JsonValue(NameIn(*region.colour)) : JsonValue(), "centroid",
      core::ListOf(std::vector{region.centroid.x(), region.centroid.y()}));
}

JsonValue SightingJson(const vision::CylinderSighting& sighting) {
  JsonValue json = report::ObjectTree("orientation_deg", math::RadToDeg(sighting.orientation_rad));
  const math::Vector3& p = sighting.p_LT_L;
  report::SetMembers(json, "position_m", core::ListOf(std::vector{p.x(), p.y(), p.z()}),
                     "distance_by_stereo_m", sighting.distance_by_stereo_m, "distance_by_size_m",
                     sighting.distance_by_size_m);
  JsonValue::List rows;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d row = sighting.covariance.row(i);
    rows.push_back(core::ListOf(std::vector<double>(row.data(), row.data() + row.size())));
  }
  json.Set("covariance", JsonValue(std::move(rows)));
  JsonValue regions = JsonValue::Object();
  report::SetMembers(regions, "left", core::ListOf(sighting.regions[0], RegionJson), "right",
                     core::ListOf(sighting.regions[1], RegionJson));
  json.Set("regions", std::move(regions));
  return json;
}

Rgb BoxColour(const vision::ColourRegion& region) {
  if (!region.colour) return {255, 255, 255};
  switch (*region.colour) {
    case vision::CylinderColour::kBlue:
      return {0, 255, 255};
    case vision::CylinderColour::kMagenta:
      return {255, 0, 255};
    case vision::CylinderColour::kRed:
      return {255, 255, 0};
  }
  return {255, 255, 255};
}

void CopyInto(const vision::ColourImage& image, int first_column, Picture& picture) {
  for (int y = 0; y < image.height(); ++y) {
    const auto row = image.Row(y);
    std::copy(row.begin(), row.end(), picture.Row(y).begin() + first_column);
  }
}

// Draws the box around a region, one pixel outside of it.
void DrawBox(const vision::ColourRegion& region, int first_column, Picture& picture) {
  const double left = first_column + region.left - 1.0;
  const double right = first_column + region.right + 1.0;
  const double top = region.top - 1.0;
  const double bottom = region.bottom + 1.0;
  const Rgb colour = BoxColour(region);
  DrawLine({{left, top}, {right, top}}, colour, 1, picture);
  DrawLine({{left, bottom}, {right, bottom}}, colour, 1, picture);
  DrawLine({{left, top}, {left, bottom}}, colour, 1, picture);
  DrawLine({{right, top}, {right, bottom}}, colour, 1, picture);
}

// Returns both images side by side, with the bounding boxes of the regions: that of the whole
// cylinder white, those of quadrants in pure colours of their classes. Where nothing was found it
// is the images alone.
Picture CylinderPicture(const vision::ColourImage& left, const vision::ColourImage& right,
                        const vision::CylinderFinding& finding) {
  Picture picture(left.width() + right.width(), std::max(left.height(), right.height()));
  CopyInto(left, 0, picture);
  CopyInto(right, left.width(), picture);
  if (!finding.sighting) return picture;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const int first_column = eye == 0 ? 0 : left.width();
    const auto& regions = finding.sighting->regions.at(eye);
    // Quadrants are drawn first, so that the box of the whole stays visible about them.
    for (std::size_t i = regions.size(); i > 0; --i) {
      DrawBox(regions[i - 1], first_column, picture);
    }
  }
  return picture;
}

}  // namespace

void CylinderParams::Visit(core::FieldVisitor& v) {
  v.Group("cylinder", cylinder, "the cylinder");
  v.Group("robust", robust, "of the finder that is used without --published");
  v.Group("published", published, "of the published finder, which --published uses");
}

vision::ColourImage ReadColour(const fs::path& path, std::string& what) {
  const image_files::RawImage raw = image_files::ReadImage(path);
  if (!raw.is_colour()) {
    throw core::UserError(path.string(), "is grey, and the cylinder is known by its colours",
                          "give colour images: red, green and blue");
  }
  what = image_files::DescribeImage(raw);
  if (raw.full_scale != 255) what += fmt::format("; scaled by 255 / {}", raw.full_scale);
  vision::ColourImage image(raw.width(), raw.height());
  for (int y = 0; y < raw.height(); ++y) {
    for (int x = 0; x < raw.width(); ++x) {
      const auto primary = [&](std::size_t plane) {
        return ToByte(raw.planes[plane].At(x, y), raw.full_scale);
      };
      image.At(x, y) = {primary(0), primary(1), primary(2)};
    }
  }
  return image;
}

CylinderResult FindCylinderInFiles(const CylinderRequest& request) {
  CylinderResult result;
  result.params = CylinderParamsOf(request);
  std::optional<OutputFolder> folder;
  if (!request.out.empty()) {
    folder.emplace(request.out, request.existing,
                   OutputPlan{.command = "cylinder",
                              .names = {"regions.png", "cylinder.json"},
                              .inputs = {request.left, request.right, request.cameras}});
  }
  const vision::ColourImage left = ReadColour(request.left, result.read[0]);
  const vision::ColourImage right = ReadColour(request.right, result.read[1]);
  CheckColourPair(request, left, right);
  const vision::CameraPair cameras = vision::LoadCameraPair(request.cameras);
  CheckCamera(request, "left", cameras.left, left);
  CheckCamera(request, "right", cameras.right, right);
  const vision::ColourPair pair{left, right, cameras.left, cameras.right};
  // The published finder knows no axis.
  if (request.finder == CylinderFinder::kRobust) CheckAxis(request, pair, result.params.cylinder);
  result.finding =
      request.finder == CylinderFinder::kPublished
          ? vision::FindCylinderAsPublished(pair, result.params.cylinder, result.params.published)
          : vision::FindCylinder(pair, result.params.cylinder, result.params.robust);
  if (!folder) return result;
  folder->Write("regions", "regions.png",
                image_files::EncodePng(CylinderPicture(left, right, result.finding)));
  result.files = folder->files();
  folder->Write("summary", "cylinder.json", core::DumpJson(CylinderJson(request, result)));
  folder->Finish();
  result.files = folder->files();
  return result;
}

JsonValue CylinderJson(const CylinderRequest& request, const CylinderResult& result) {
  JsonValue json = report::ObjectTree(
      "schema_version", 1, "left",
      report::ObjectTree("file", request.left.string(), "what", result.read[0]), "right",
      report::ObjectTree("file", request.right.string(), "what", result.read[1]), "finder",
      request.finder == CylinderFinder::kPublished ? "published" : "robust", "parameters",
      core::WriteParams(result.params));
  const vision::CylinderFinding& finding = result.finding;
  report::SetMembers(json, "found", finding.sighting.has_value(), "miss",
                     finding.sighting ? JsonValue() : JsonValue(NameIn(finding.miss)), "reason",
                     finding.sighting ? JsonValue() : JsonValue(finding.reason), "sighting",
                     finding.sighting ? SightingJson(*finding.sighting) : JsonValue(), "files",
                     FilesJson(result.files), "program", core::VersionLine());
  return json;
}

}  // namespace rockyard::campaign
