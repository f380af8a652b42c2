// Renders a stereo pair of soil and rocks for scripts/studies/texture/texture.py:
//
//   soil_pictures OUT GRAININESS SUN_DEG ROCKS_PER_LAW MRAD COLUMNS PITCH_DEG HEIGHT_M BASELINE_M
//
// GRAININESS is soil_graininess, ROCKS_PER_LAW the k of the rocks per m2, MRAD the angle of a pixel
// in the middle of the square images, PITCH_DEG how far the cameras look down. Writes OUT_left.pgm
// and OUT_right.pgm as the camera delivers them, and OUT_left.pfm, the radiance of the left one
// before lens and imager.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"
#include "terrain/field.h"

namespace rockyard::rendering {
namespace {

constexpr core::TrialKey kKey{31, 0};

template <typename T>
void Write(const std::string& path, const std::string& magic, const std::string& most,
           const vision::Image<T>& image, bool from_below) {
  std::ofstream file(path, std::ios::binary);
  file << magic << '\n' << image.width() << ' ' << image.height() << '\n' << most << '\n';
  for (int i = 0; i < image.height(); ++i) {
    const auto line = std::as_bytes(image.Row(from_below ? image.height() - 1 - i : i));
    file.write(reinterpret_cast<const char*>(line.data()),
               static_cast<std::streamsize>(line.size()));
  }
  if (!file) {
    std::fprintf(stderr, "soil_pictures: cannot write %s\n", path.c_str());
    std::exit(2);
  }
}

void Run(const std::string& out, const std::array<double, 8>& numbers) {
  const auto [graininess, sun_deg, k_per_m2, mrad, columns_d, pitch_deg, height_m, baseline_m] =
      numbers;
  const auto columns = static_cast<int>(columns_d);
  terrain::TerrainParams terrain_params;
  terrain_params.rocks.k_per_m2 = k_per_m2;
  terrain_params.arena.kind = terrain::ArenaKind::kOpen;
  const terrain::Terrain terrain =
      terrain::BuildField(terrain_params, kKey, terrain::Course{}).terrain;
  const SunParams sun{.elevation_rad = math::DegToRad(sun_deg),
                      .azimuth_rad = math::DegToRad(100.0)};
  PictureParams params;
  params.look.soil_graininess = graininess;
  const PictureScene scene(terrain, sun, params.look, params.camera.imager.filter_width_m, {});
  TerrainLook look(terrain, sun, params.look, kKey);
  const double view_rad = 2.0 * std::atan(0.5 * columns * mrad * 1e-3);
  for (int eye = 0; eye < 2; ++eye) {
    const vision::CameraModel camera =
        PinholeAt({0.0, (0.5 - eye) * baseline_m, height_m}, math::DegToRad(pitch_deg), columns,
                  columns, view_rad);
    const PixelRays rays(camera);
    Picture picture(columns, columns);
    PictureRenderer(scene, params.look, rays, math::Transform::Identity())
        .RenderRows(0, columns, look, picture);
    const PictureReadout readout(params.camera, rays, eye, kKey);
    const auto rates = readout.Rates(picture);
    const RawImage raw =
        readout.Read(rates, readout.Exposure(rates), static_cast<ImageNumber>(eye));
    const auto bits = static_cast<int>(params.camera.imager.detector().adc_bits);
    Write(out + (eye == 0 ? "_left.pgm" : "_right.pgm"), "P5", "255", ToGray(raw.counts, bits),
          false);
    static_assert(std::endian::native == std::endian::little);
    if (eye == 0) Write(out + "_left.pfm", "Pf", "-1", picture.radiance_w_m2_sr, true);
  }
}

}  // namespace
}  // namespace rockyard::rendering

int main(int argc, char** argv) {
  std::array<double, 8> numbers{};
  if (argc != static_cast<int>(numbers.size()) + 2) {
    std::fprintf(stderr,
                 "usage: soil_pictures OUT GRAININESS SUN_DEG ROCKS_PER_LAW MRAD COLUMNS PITCH_DEG "
                 "HEIGHT_M BASELINE_M\n");
    return 2;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::atof(argv[i + 2]);
  rockyard::rendering::Run(argv[1], numbers);
  return 0;
}
