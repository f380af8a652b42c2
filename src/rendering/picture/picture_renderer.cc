#include "rendering/picture/picture_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Neighbours whose direct sunlight differs by more than this share of what falls on a surface that
// faces the sun are split.
constexpr double kSunStep = 0.06;

// Returns a side of the parallelogram of a surface that a pixel covers: the ray turns by `by` from
// one pixel to the next, and the point moves by t (by - ray (n.by) / (n.ray)), which lies in the
// tangent plane.
Vector3 Swept(const Vector3& by, const Vector3& ray, const Vector3& normal, double range_m) {
  // A ray along the surface would see an endless strip of it.
  constexpr double kGrazing = 1e-6;
  const double facing = std::min(normal.dot(ray), -kGrazing);
  return range_m * (by - ray * (normal.dot(by) / facing));
}

}  // namespace

// What the rendering of a row and its neighbours keeps: what the rays of rows have met, by row
// modulo 3, and the rocks that the tiles of two rows of tiles may show, by row of tiles modulo 2.
struct PictureRenderer::Band {
  std::array<Row, 3> rows;
  std::array<int, 3> numbers{-1, -1, -1};
  std::array<std::vector<std::vector<int>>, 2> candidates;
  std::array<int, 2> tile_rows{-1, -1};
  // The rocks that a row of blocks and one pixel may show.
  std::vector<std::vector<int>> in_blocks;
  int block_row = -1;
  std::vector<int> in_pixel;
};

PictureRenderer::PictureRenderer(const PictureScene& scene, const LookParams& look,
                                 const PixelRays& rays, const math::Transform& X_WA)
    : scene_(scene), rays_(rays), X_WA_(X_WA), edge_samples_(static_cast<int>(look.edge_samples)) {}

SurfaceLook PictureRenderer::LookAt(const SurfacePoint& point, const Vector3& ray_W, double range_m,
                                    int column, int row, TerrainLook& look) const {
  const Vector3 by_column_W = X_WA_.linear() * rays_.ByColumn(column, row);
  const Vector3 by_row_W = X_WA_.linear() * rays_.ByRow(column, row);
  return look.At(point, Swept(by_column_W, ray_W, point.normal_W, range_m),
                 Swept(by_row_W, ray_W, point.normal_W, range_m));
}

void PictureRenderer::FindInBlocks(int block_row, Band& band) const {
  band.block_row = block_row;
  band.in_blocks.resize(static_cast<std::size_t>(rays_.block_columns()));
  for (int b = 0; b < rays_.block_columns(); ++b) {
    const PixelRays::Tile& block = rays_.BlockAt(b, block_row);
    scene_.RocksInCone(X_WA_ * block.origin_A, block.origin_spread_m, InWorld(block.cone),
                       band.in_blocks[static_cast<std::size_t>(b)]);
  }
}

const std::vector<int>& PictureRenderer::Candidates(int column, int row, Band& band) const {
  const int tile_row = row / PixelRays::kTile;
  const auto slot = static_cast<std::size_t>(tile_row % 2);
  auto& candidates = band.candidates[slot];
  if (band.tile_rows[slot] != tile_row) {
    band.tile_rows[slot] = tile_row;
    const int block_row = tile_row / PixelRays::kTilesPerBlock;
    if (band.block_row != block_row) FindInBlocks(block_row, band);
    candidates.resize(static_cast<std::size_t>(rays_.tile_columns()));
    for (int t = 0; t < rays_.tile_columns(); ++t) {
      const PixelRays::Tile& tile = rays_.TileAt(t, tile_row);
      const auto& among = band.in_blocks[static_cast<std::size_t>(t / PixelRays::kTilesPerBlock)];
      scene_.RocksInCone(X_WA_ * tile.origin_A, tile.origin_spread_m, InWorld(tile.cone), among,
                         candidates[static_cast<std::size_t>(t)]);
    }
  }
  return candidates[static_cast<std::size_t>(column / PixelRays::kTile)];
}

// Returns the rocks that the rays within one pixel may meet.
const std::vector<int>& PictureRenderer::InPixel(int column, int row, Band& band) const {
  const std::vector<int>& in_tile = Candidates(column, row, band);
  const vision::Ray ray = rays_.At(column, row);
  const double chord = 0.5 * (rays_.ByColumn(column, row).norm() + rays_.ByRow(column, row).norm());
  scene_.RocksInCone(OriginOf(ray), 0.0, InWorld(RayCone::Around(ray.direction, chord)), in_tile,
                     band.in_pixel);
  return band.in_pixel;
}

const PictureRenderer::Row& PictureRenderer::MeetRow(int row, Band& band) const {
  const auto slot = static_cast<std::size_t>(row % 3);
  Row& met = band.rows[slot];
  if (band.numbers[slot] == row) return met;
  band.numbers[slot] = row;
  met.resize(static_cast<std::size_t>(rays_.columns()));
  for (int column = 0; column < rays_.columns(); ++column) {
    Pixel& pixel = met[static_cast<std::size_t>(column)];
    pixel.sees = rays_.Sees(column, row);
    if (!pixel.sees) continue;
    const vision::Ray ray = rays_.At(column, row);
    pixel.met = scene_.Meet(OriginOf(ray), DirectionOf(ray), Candidates(column, row, band));
  }
  return met;
}

bool PictureRenderer::IsEdge(const Pixel& a, const Pixel& b) const {
  if (!a.sees || !b.sees) return false;
  if (!IsOneSurface(a.met.point, b.met.point)) return true;
  if (a.met.sunlit == b.met.sunlit) return false;
  const auto direct = [this](const Met& met) {
    return met.sunlit * std::max(0.0, met.point.normal_W.dot(scene_.light().toward_sun_W));
  };
  return std::abs(direct(a.met) - direct(b.met)) > kSunStep;
}

bool PictureRenderer::HasEdge(int column, int row, Band& band) const {
  const auto c = static_cast<std::size_t>(column);
  const Row& here = MeetRow(row, band);
  if (column > 0 && IsEdge(here[c - 1], here[c])) return true;
  if (column + 1 < rays_.columns() && IsEdge(here[c], here[c + 1])) return true;
  if (row > 0 && IsEdge(MeetRow(row - 1, band)[c], here[c])) return true;
  return row + 1 < rays_.rows() && IsEdge(here[c], MeetRow(row + 1, band)[c]);
}

double PictureRenderer::WholePixel(int column, int row, const Met& met, TerrainLook& look) const {
  const Vector3 ray_W = DirectionOf(rays_.At(column, row));
  if (met.point.surface == SurfacePoint::kSky) {
    return scene_.Radiance(met, ray_W, 0.0, Vector3::UnitZ());
  }
  const SurfaceLook seen = LookAt(met.point, ray_W, met.range_m, column, row, look);
  return scene_.Radiance(met, ray_W, seen.albedo, seen.normal_W);
}

// How one pixel sees the surfaces in it. Each surface has one look, with its texture over the whole
// pixel, taken where the pixel first meets the surface.
class PictureRenderer::PixelLooks {
 public:
  struct Seen {
    int surface = SurfacePoint::kSky;
    double albedo = 0.0;
    Vector3 tilt_W = Vector3::Zero();  // of the normal, by relief
  };

  template <typename LookOf>
  const Seen& Of(const SurfacePoint& point, const LookOf& look_of) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (seen_[i].surface == point.surface) return seen_[i];
    }
    // Where a pixel shows more surfaces than kMost, the last look is replaced.
    const std::size_t i = std::min(count_, kMost - 1);
    count_ = i + 1;
    const SurfaceLook whole = look_of();
    seen_[i] = {point.surface, whole.albedo, whole.normal_W - point.normal_W};
    return seen_[i];
  }

 private:
  static constexpr std::size_t kMost = 4;
  std::array<Seen, kMost> seen_;
  std::size_t count_ = 0;
};

double PictureRenderer::SplitPixel(int column, int row, Band& band, TerrainLook& look) const {
  const std::vector<int>& rocks = InPixel(column, row, band);
  const Pixel& middle = MeetRow(row, band)[static_cast<std::size_t>(column)];
  const auto meet = [&](int x, int y) {
    const double size = 1.0 / edge_samples_;
    const vision::Ray ray =
        rays_.Beside(column, row, (x + 0.5) * size - 0.5, (y + 0.5) * size - 0.5);
    const Vector3 ray_W = DirectionOf(ray);
    return Part{ray_W, {scene_.Meet(OriginOf(ray), ray_W, rocks), true}};
  };
  // The edge may run through the neighbour only: then all four corners are as the middle.
  const int last = edge_samples_ - 1;
  const std::array<Part, 4> corners{meet(0, 0), meet(last, 0), meet(0, last), meet(last, last)};
  if (std::none_of(corners.begin(), corners.end(),
                   [&](const Part& part) { return IsEdge(middle, part.pixel); })) {
    return WholePixel(column, row, middle.met, look);
  }
  PixelLooks looks;
  const auto seen_at = [&](const Met& met, const Vector3& ray_W) -> const PixelLooks::Seen& {
    return looks.Of(met.point,
                    [&] { return LookAt(met.point, ray_W, met.range_m, column, row, look); });
  };
  const auto radiance = [&](const Part& part) {
    const Met& met = part.pixel.met;
    if (met.point.surface == SurfacePoint::kSky) {
      return scene_.Radiance(met, part.ray_W, 0.0, Vector3::UnitZ());
    }
    const PixelLooks::Seen& seen = seen_at(met, part.ray_W);
    const Vector3 normal_W = (met.point.normal_W + seen.tilt_W).normalized();
    return scene_.Radiance(met, part.ray_W, seen.albedo, normal_W);
  };
  // The look of the surface in the middle is taken there, the looks of other surfaces where a part
  // first meets them: the order decides bits.
  if (middle.met.point.surface != SurfacePoint::kSky) {
    seen_at(middle.met, DirectionOf(rays_.At(column, row)));
  }
  double sum = 0.0;
  for (const Part& part : corners) sum += radiance(part);
  for (int y = 0; y < edge_samples_; ++y) {
    for (int x = 0; x < edge_samples_; ++x) {
      if ((x == 0 || x == last) && (y == 0 || y == last)) continue;
      sum += radiance(meet(x, y));
    }
  }
  return sum / (edge_samples_ * edge_samples_);
}

void PictureRenderer::RenderRows(int first, int last, TerrainLook& look, Picture& picture) const {
  EXPECT(picture.columns() == rays_.columns() && picture.rows() == rays_.rows());
  EXPECT(first >= 0 && first <= last && last <= rays_.rows());
  look.Trim();
  Band band;
  for (int row = first; row < last; ++row) {
    for (int column = 0; column < rays_.columns(); ++column) {
      const Pixel& pixel = MeetRow(row, band)[static_cast<std::size_t>(column)];
      if (!pixel.sees) continue;
      picture.range_m.At(column, row) = pixel.met.range_m;
      picture.surface.At(column, row) = pixel.met.point.surface;
      picture.normal_W.At(column, row) = pixel.met.point.normal_W.cast<float>();
      picture.sunlit.At(column, row) = static_cast<float>(pixel.met.sunlit);
      const bool split = edge_samples_ > 1 && HasEdge(column, row, band);
      picture.radiance_w_m2_sr.At(column, row) = static_cast<float>(
          split ? SplitPixel(column, row, band, look) : WholePixel(column, row, pixel.met, look));
    }
  }
}

}  // namespace rockyard::rendering
