#include "terrain/rock_layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/random.h"
#include "math/angles.h"
#include "terrain/arena.h"
#include "terrain/marked_field.h"
#include "terrain/rock.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {

namespace {

using core::Purpose;
using core::RandomStream;

// Attempts to place one rock before it is given up: laws drop it, an exact count is an error.
constexpr int kMaxAttempts = 1000;
// Substream of the first rock outside the count area, so that the rocks inside keep their streams
// when the count changes. Must stay above every count that parameters allow.
constexpr std::uint32_t kFirstOutsideCount = 1u << 20;

// Returns a rock at the origin with random size, shape and yaw. Records depend on the order of its
// draws. Width ratio and yaw must stay uniform: blind_swath.h has its closed form by them.
Rock DrawRock(const RockFieldParams& params, const RockSizeLaw& law, core::TrialKey key,
              std::uint32_t substream) {
  RandomStream size(key, Purpose::kRockSize, substream);
  RandomStream shape(key, Purpose::kRockShape, substream);
  RockOutline outline;
  outline.diameter_m = law.Diameter(size.Uniform());
  outline.width_ratio = core::SampleUniform(shape, params.min_width_ratio, params.max_width_ratio);
  const double height_ratio =
      core::SampleUniform(shape, params.min_height_ratio, params.max_height_ratio);
  const double buried = core::SampleUniform(shape, params.burial_mean - params.burial_spread,
                                            params.burial_mean + params.burial_spread);
  // c in proportion to a = D/2. Of the full height 2 c the buried share lies below the ground, so
  // the top stands at h = 2 c (1 - buried).
  outline.half_height_m = 0.5 * outline.diameter_m * height_ratio;
  outline.height_m = 2.0 * outline.half_height_m * (1.0 - buried);
  Rock rock = ShapeRock(outline, params.pointedness);
  // An ellipse looks the same after half a turn.
  rock.yaw_rad = core::SampleUniform(shape, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  return rock;
}

// Returns the mirror line that rocks keep off, if any.
std::optional<double> LineToKeepOff(const TerrainParams& params) {
  if (!params.arena.IsVirtual() || params.rocks.mirror_line == LineRule::kMerge) return {};
  return params.arena.MirrorLine();
}

class LayoutBuilder {
 public:
  LayoutBuilder(const TerrainParams& params, core::TrialKey key, const Course& course)
      : params_(params.rocks),
        key_(key),
        law_(MakeReferenceSizeLaw(params.rocks)),
        placement_(LayoutBounds(params), course, params.rocks.clear_radius_m,
                   LineToKeepOff(params)) {
    if (params_.FollowsLaw() && params_.clusters_per_m2 > 0.0) clusters_.emplace(params, key);
  }

  // Places rock `substream` at random in `area`, outside `hole` if there is one. Where
  // `drop_in_clear_zones`, a rock that is first drawn into a clear zone is dropped, which leaves
  // the density elsewhere at the law's; otherwise it is placed elsewhere. Returns false where the
  // rock was dropped.
  bool Place(std::uint32_t substream, const Rectangle& area, const Rectangle* hole,
             bool drop_in_clear_zones) {
    ++layout_.drawn;
    Rock rock = DrawRock(params_, *law_, key_, substream);
    RandomStream stream(key_, Purpose::kRockPlacement, substream);
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      const Disc disc = DrawPosition(stream, area, hole, 0.5 * rock.diameter_m);
      if (!placement_.ClearOfCourse(disc)) {
        // The rock is dropped only where its first draw falls into a clear zone. A rock that is
        // moved for overlap was first drawn outside, and must stay in the field.
        if (!drop_in_clear_zones || attempt > 0) continue;
        ++layout_.dropped_in_clear_zones;
        return false;
      }
      if (params_.overlap != OverlapRule::kAllow && !placement_.Free(disc)) {
        // kReject drops the rock, kRelocate draws another place.
        if (params_.overlap == OverlapRule::kReject) break;
        continue;
      }
      if (attempt > 0) ++layout_.relocated;
      placement_.Add(disc);
      rock.center_W.head<2>() << disc.x_m, disc.y_m;
      layout_.rocks.push_back(rock);
      return true;
    }
    ++layout_.dropped_for_overlap;
    return false;
  }

  // Adds a rock that stands where it is given. Those that are placed later keep off it, where the
  // overlap rule lets them.
  void AddGiven(const Rock& rock) {
    ++layout_.drawn;
    placement_.Add({rock.center_W.x(), rock.center_W.y(), 0.5 * rock.diameter_m});
    layout_.rocks.push_back(rock);
  }

  RockLayout Take() { return std::move(layout_); }

 private:
  // Returns a place by the clusters, where there are any; otherwise one that is uniform in the area
  // less the hole, by rejection.
  Disc DrawPosition(RandomStream& stream, const Rectangle& area, const Rectangle* hole,
                    double radius_m) const {
    Disc disc{0.0, 0.0, radius_m};
    if (clusters_) {
      const CoursePoint place = clusters_->Draw(stream);
      return {place.x_m, place.y_m, radius_m};
    }
    do {
      disc.x_m = core::SampleUniform(stream, area.x_min_m, area.x_max_m);
      disc.y_m = core::SampleUniform(stream, area.y_min_m, area.y_max_m);
    } while (hole != nullptr && hole->Contains(disc.x_m, disc.y_m));
    return disc;
  }

  RockFieldParams params_;
  core::TrialKey key_;
  std::unique_ptr<RockSizeLaw> law_;
  Placement placement_;
  std::optional<RockClusters> clusters_;
  RockLayout layout_;
};

void LayOutLaw(const TerrainParams& params, core::TrialKey key, LayoutBuilder& builder) {
  const Rectangle area = LayoutBounds(params);
  // Each rock is placed by its own streams and by those before it alone: fields nest.
  for (const std::uint32_t substream : RocksOfField(params, key)) {
    builder.Place(substream, area, nullptr, true);
  }
}

// Lays out exactly `count` rocks in the count area; the rest of the layout area, if any, is filled
// at the same density, to the nearest whole rock.
void LayOutExactCount(const TerrainParams& params, LayoutBuilder& builder) {
  const Rectangle inside = CountArea(params.rocks);
  const Rectangle all = LayoutBounds(params);
  // The rest of the layout area gets the count area's density, rounded to a whole number of rocks.
  const double outside_m2 = std::max(all.Area() - inside.Area(), 0.0);
  const auto inside_count = static_cast<std::uint32_t>(params.rocks.count);
  const auto outside_count =
      static_cast<std::uint32_t>(std::lround(params.rocks.RocksPerM2() * outside_m2));
  bool complete = true;
  for (std::uint32_t i = 0; i < inside_count; ++i) {
    complete = builder.Place(i, inside, nullptr, false) && complete;
  }
  for (std::uint32_t i = 0; i < outside_count; ++i) {
    complete = builder.Place(kFirstOutsideCount + i, all, &inside, false) && complete;
  }
  if (!complete) {
    throw std::runtime_error("no place without overlap for every rock of an exact count");
  }
}

// Returns a rock of which a share `buried` of the full height 2 c is below the ground: h =
// 2 c (1 - buried).
Rock ListedRock(const ListedRocksParams& list, std::size_t i, const RockFieldParams& params) {
  const double buried = list.buried_share.empty() ? params.burial_mean : list.buried_share[i];
  const RockOutline outline{.diameter_m = list.diameter_m[i],
                            .width_ratio = list.width_ratio.empty() ? 1.0 : list.width_ratio[i],
                            .half_height_m = 0.5 * list.height_m[i] / (1.0 - buried),
                            .height_m = list.height_m[i]};
  Rock rock = ShapeRock(outline, params.pointedness);
  rock.center_W.head<2>() << list.x_m[i], list.y_m[i];
  if (!list.yaw_deg.empty()) rock.yaw_rad = math::DegToRad(list.yaw_deg[i]);
  return rock;
}

}  // namespace

Rock GivenRock(const RockFieldParams& params, const CoursePoint& place, double diameter_m,
               double height_m) {
  const ListedRocksParams one{
      .x_m = {place.x_m}, .y_m = {place.y_m}, .diameter_m = {diameter_m}, .height_m = {height_m}};
  return ListedRock(one, 0, params);
}

RockLayout LayOutRocks(const TerrainParams& params, core::TrialKey key, const Course& course) {
  const RockFieldParams& rocks = params.rocks;
  LayoutBuilder builder(params, key, course);
  if (rocks.kind == RockFieldKind::kListed) {
    for (std::size_t i = 0; i < rocks.listed.x_m.size(); ++i) {
      builder.AddGiven(ListedRock(rocks.listed, i, rocks));
    }
  }
  switch (rocks.RandomKind()) {
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
      break;
    case RockFieldKind::kMoore:
    case RockFieldKind::kGolombek:
      LayOutLaw(params, key, builder);
      break;
    case RockFieldKind::kUniformCount:
      LayOutExactCount(params, builder);
      break;
  }
  return builder.Take();
}

namespace {

// Cells decide time and memory alone.
constexpr double kSmallestCell_m = 0.5;
// Bounds the memory for wide, sparse fields: the cells grow instead.
constexpr double kMaxCells = 250000.0;

bool Overlap(const Disc& a, const Disc& b) {
  // |c_a - c_b| < r_a + r_b; discs that touch do not overlap.
  const double dx = a.x_m - b.x_m;
  const double dy = a.y_m - b.y_m;
  const double reach = a.radius_m + b.radius_m;
  return dx * dx + dy * dy < reach * reach;
}

}  // namespace

Placement::Placement(const Rectangle& layout, const Course& course, double clear_radius_m,
                     std::optional<double> line_to_keep_off_m)
    : layout_(layout),
      points_(course.Points()),
      clear_radius_m_(clear_radius_m),
      line_to_keep_off_m_(line_to_keep_off_m),
      cell_m_(std::max(kSmallestCell_m, std::sqrt(layout.Area() / kMaxCells))),
      nx_(static_cast<int>((layout.x_max_m - layout.x_min_m) / cell_m_) + 1),
      ny_(static_cast<int>((layout.y_max_m - layout.y_min_m) / cell_m_) + 1),
      cells_(static_cast<std::size_t>(nx_) * ny_) {}

// Clear zones are discs around the points of the course, and rocks keep out with their whole
// outline.
bool Placement::ClearOfCourse(const Disc& disc) const {
  return std::none_of(points_.begin(), points_.end(), [&](const CoursePoint& point) {
    return Overlap(disc, {point.x_m, point.y_m, clear_radius_m_});
  });
}

// Discs beyond the layout go to its border cells, both when added and when asked for.
Placement::Cells Placement::CellsOf(const Disc& disc) const {
  const auto index = [this](double offset_m, int cells) {
    return std::clamp(static_cast<int>(std::floor(offset_m / cell_m_)), 0, cells - 1);
  };
  const double dx = disc.x_m - layout_.x_min_m;
  const double dy = disc.y_m - layout_.y_min_m;
  return {index(dx - disc.radius_m, nx_), index(dx + disc.radius_m, nx_),
          index(dy - disc.radius_m, ny_), index(dy + disc.radius_m, ny_)};
}

bool Placement::Free(const Disc& disc) const {
  if (line_to_keep_off_m_ && std::abs(disc.y_m) + disc.radius_m > *line_to_keep_off_m_) {
    return false;
  }
  const Cells cells = CellsOf(disc);
  // Two discs that overlap share a cell of their bounding boxes, so looking into the disc's own
  // cells is enough.
  for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
    for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
      for (const Disc& other : cells_[static_cast<std::size_t>(iy) * nx_ + ix]) {
        if (Overlap(disc, other)) return false;
      }
    }
  }
  return true;
}

// Adds the disc to every cell that its bounding box touches.
void Placement::Add(const Disc& disc) {
  const Cells cells = CellsOf(disc);
  for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
    for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
      cells_[static_cast<std::size_t>(iy) * nx_ + ix].push_back(disc);
    }
  }
}

}  // namespace rockyard::terrain
