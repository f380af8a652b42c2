// Renders what a stereo pair sees of a scenario's terrain, to look at:
//
//   render_pair SCENARIO OUT [PATH=VALUE]...
//
// writes OUT_left.png and OUT_right.png, OUT_disparity.pfm (columns of the left image less those of
// the right one, by pixel of the left one; NaN where the right eye does not see the point) and
// OUT_disparity.png, the same to look at. PATH names a member of PairSettings ("columns=1024",
// "sun.elevation_deg=20", "picture.look.soil_graininess=1").

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "core/archive.h"
#include "core/json_file.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"
#include "scenario/load.h"
#include "terrain/field.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

using core::Assumed;

struct PairSettings {
  PictureParams picture;
  SunParams sun;
  std::int64_t columns = 512;
  std::int64_t trial = 0;
  double view_rad = math::DegToRad(45.0);
  double pitch_rad = math::DegToRad(20.0);
  double height_m = 1.0;
  double baseline_m = 0.2;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  void Visit(core::FieldVisitor& v) {
    v.Group("picture", picture, "appearance and camera");
    v.Group("sun", sun, "sun and albedos");
    v.Integer("columns", columns, Assumed("of the square images", {}, {16, 4096}));
    v.Integer("trial", trial, Assumed("of the scenario's seed", {}, {0, 1e6}));
    v.Angle("view_deg", view_rad, Assumed("field of view", {}, {5, 150}));
    v.Angle("pitch_deg", pitch_rad, Assumed("of the cameras, down", {}, {-90, 90}));
    v.Real("height_m", height_m, Assumed("of the cameras", {}, {0.01, 100}));
    v.Real("baseline_m", baseline_m, Assumed("from left to right", {}, {0.001, 10}));
    v.Real("x_m", x_m, Assumed("of the rover", {}, {-1000, 1000}));
    v.Real("y_m", y_m, Assumed("of the rover", {}, {-1000, 1000}));
    v.Angle("heading_deg", heading_rad, Assumed("of the rover", {}, {-360, 360}));
  }
};

void WritePng(const std::string& path, const vision::GrayImage& gray) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(gray.width());
  image.height = static_cast<png_uint_32>(gray.height());
  image.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&image, path.c_str(), 0, gray.values().data(), 0, nullptr) == 0) {
    throw std::runtime_error("cannot write " + path);
  }
}

// Portable float map: rows from below, little-endian.
void WritePfm(const std::string& path, const vision::Image<float>& values) {
  static_assert(std::endian::native == std::endian::little);
  std::ofstream file(path, std::ios::binary);
  file << "Pf\n" << values.width() << ' ' << values.height() << "\n-1\n";
  for (int row = values.height() - 1; row >= 0; --row) {
    const auto line = std::as_bytes(values.Row(row));
    file.write(reinterpret_cast<const char*>(line.data()),
               static_cast<std::streamsize>(line.size()));
  }
  if (!file) throw std::runtime_error("cannot write " + path);
}

vision::Image<float> Disparity(const StereoTruth& truth) {
  vision::Image<float> disparity(truth.other.width(), truth.other.height(),
                                 std::numeric_limits<float>::quiet_NaN());
  vision::ForEachPixel(disparity.width(), disparity.height(), [&](int column, int row) {
    if (truth.other.At(column, row) != OtherEye::kVisible) return;
    disparity.At(column, row) = static_cast<float>(column - truth.other_column.At(column, row));
  });
  return disparity;
}

vision::GrayImage ToLookAt(const vision::Image<float>& disparity) {
  float most = 1.0F;
  for (const float d : disparity.values()) most = std::max(most, std::isnan(d) ? 0.0F : d);
  vision::GrayImage gray(disparity.width(), disparity.height());
  std::transform(disparity.values().begin(), disparity.values().end(), gray.values().begin(),
                 [most](float d) {
                   if (std::isnan(d)) return std::uint8_t{0};
                   return static_cast<std::uint8_t>(std::clamp(255.0F * d / most, 0.0F, 255.0F));
                 });
  return gray;
}

void Run(const std::string& scenario_path, const std::string& out,
         const std::vector<std::string>& overrides) {
  PairSettings settings;
  core::JsonValue document = core::WriteParams(settings);
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  core::ReadParams(document, settings);
  const auto scenario = scenario::LoadScenario(scenario_path);
  const core::TrialKey key{static_cast<std::uint64_t>(scenario.seed),
                           static_cast<std::uint32_t>(settings.trial)};
  const terrain::Terrain terrain =
      terrain::BuildField(scenario.drive.terrain, key, terrain::Course{}).terrain;
  const PictureParams& picture = settings.picture;
  const PictureScene scene(terrain, settings.sun, picture.look,
                           picture.camera.imager.filter_width_m, {});
  const math::Transform X_WR =
      math::MakePose({settings.x_m, settings.y_m, terrain.Height(settings.x_m, settings.y_m)},
                     settings.heading_rad, 0.0, 0.0);
  TerrainLook look(terrain, settings.sun, picture.look, key);
  const auto columns = static_cast<int>(settings.columns);
  std::array<vision::CameraModel, 2> cameras;
  std::array<Picture, 2> pictures;
  for (int eye = 0; eye < 2; ++eye) {
    const auto i = static_cast<std::size_t>(eye);
    const double y_m = (0.5 - eye) * settings.baseline_m;
    cameras[i] = PinholeAt({0.0, y_m, settings.height_m}, settings.pitch_rad, columns, columns,
                           settings.view_rad);
    const PixelRays rays(cameras[i]);
    pictures[i] = Picture(columns, columns);
    PictureRenderer(scene, picture.look, rays, X_WR).RenderRows(0, columns, look, pictures[i]);
    const PictureReadout readout(picture.camera, rays, eye, key);
    const auto rates = readout.Rates(pictures[i]);
    const RawImage raw =
        readout.Read(rates, readout.Exposure(rates), static_cast<ImageNumber>(eye));
    const auto bits = static_cast<int>(picture.camera.imager.detector().adc_bits);
    WritePng(out + (eye == 0 ? "_left.png" : "_right.png"), ToGray(raw.counts, bits));
    std::cout << (eye == 0 ? "left" : "right") << ": exposed for " << raw.exposure_s << " s\n";
  }
  const auto disparity =
      Disparity(SeenFromOtherEye(scene, pictures[0], PixelRays(cameras[0]), X_WR, cameras[1]));
  WritePfm(out + "_disparity.pfm", disparity);
  WritePng(out + "_disparity.png", ToLookAt(disparity));
}

}  // namespace
}  // namespace rockyard::rendering

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: render_pair SCENARIO OUT [PATH=VALUE]...\n";
    return 2;
  }
  try {
    rockyard::rendering::Run(argv[1], argv[2], {argv + 3, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "render_pair: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
