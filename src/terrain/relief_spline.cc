#include "terrain/relief_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::terrain {
namespace {

// A factor by which a power of two that was rounded down counts as one.
constexpr double kRoundingUp = 1.0 + 1e-9;

// Parts of a line shorter than this are not divided.
constexpr double kShortest_m = 1e-3;

// The four uniform cubic B-splines over a cell, and their derivatives, at t in [0, 1). Must be
// those of relief.cc (SplineWeights), as both tell one surface.
struct CellSplines {
  explicit CellSplines(double t) {
    const double s = 1.0 - t;
    value = {s * s * s / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
             (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, t * t * t / 6.0};
    slope = {-0.5 * s * s, (1.5 * t - 2.0) * t, -(1.5 * s - 2.0) * s, 0.5 * t * t};
  }
  std::array<double, 4> value{};
  std::array<double, 4> slope{};
};

// Returns U along one axis at fine node i, from coarse nodes `stride` apart; coarse[0] is the node
// i / 2, rounded down.
double Refine(const double* coarse, std::ptrdiff_t stride, int i) {
  return (i & 1) == 0 ? 0.125 * (coarse[-stride] + 6.0 * coarse[0] + coarse[stride])
                      : 0.5 * (coarse[0] + coarse[stride]);
}

// Returns the control points (Bezier) of a cubic over a cell from the nodes of its B-spline.
std::array<double, 4> ControlPoints(double a, double b, double c, double d) {
  return {(a + 4.0 * b + c) / 6.0, (4.0 * b + 2.0 * c) / 6.0, (2.0 * b + 4.0 * c) / 6.0,
          (b + 4.0 * c + d) / 6.0};
}

// The borders between cells that a line crosses along one axis. Each border must be worked out
// anew, so that it has the same bits however the line comes to it.
struct Borders {
  double position;    // in cells, where t = 0
  double t_per_cell;  // infinite for a line along the borders
  std::int64_t cell;
  double next;  // t at the next border

  // The line is in its cell at t = `from`.
  Borders(double position_in, double cells_per_t, double from)
      : position(position_in),
        t_per_cell(1.0 / cells_per_t),
        cell(static_cast<std::int64_t>(std::floor(position + from * cells_per_t))),
        next(BlockEnd(1)) {}

  void Advance() {
    cell += t_per_cell > 0.0 ? 1 : -1;
    next = BlockEnd(1);
  }
  // Returns the t at which the line leaves the block of `size` cells, a power of two, that holds
  // the cell.
  double BlockEnd(std::int64_t size) const {
    if (std::isinf(t_per_cell)) return std::numeric_limits<double>::infinity();
    const std::int64_t first = cell & ~(size - 1);
    return (static_cast<double>(t_per_cell > 0.0 ? first + size : first) - position) * t_per_cell;
  }
};

// A part of a line, and how it nears the ground at both ends.
struct Part {
  double from, to;
  Approach at_from, at_to;
};

// Returns the first t at which the gap is gone within a part that begins above the ground. The rate
// of the gap changes by no more than bend_per_m.
template <typename At>
std::optional<double> FirstCrossing(const At& at, const Part& part, double bend_per_m) {
  const double length = part.to - part.from;
  const double change = bend_per_m * length;
  const bool is_short = length < kShortest_m;
  if (part.at_to.gap_m <= 0.0) {
    if (is_short || part.at_from.rate >= change) {
      return FindCrossing([&at](double t) { return at(t).gap_m; }, part.from, part.at_from.gap_m,
                          part.to, part.at_to.gap_m);
    }
  } else {
    // A curve of that bend sags below its chord by no more than bend length^2 / 8. A gap that opens
    // all the way or closes all the way is smallest at an end.
    const double sag = 0.125 * change * length;
    if (is_short || std::min(part.at_from.gap_m, part.at_to.gap_m) > sag ||
        part.at_from.rate <= -change || part.at_to.rate >= change) {
      return std::nullopt;
    }
  }
  const double middle = 0.5 * (part.from + part.to);
  const Approach at_middle = at(middle);
  const Part first{part.from, middle, part.at_from, at_middle};
  if (const auto t = FirstCrossing(at, first, bend_per_m)) return t;
  return FirstCrossing(at, Part{middle, part.to, at_middle, part.at_to}, bend_per_m);
}

}  // namespace

ReliefSpline::ReliefSpline(std::shared_ptr<const ElevationModel> model,
                           std::shared_ptr<const RoughnessField> roughness)
    : model_(std::move(model)), roughness_(std::move(roughness)) {
  EXPECT(model_ || roughness_);
  const double cell_m = model_ ? model_->cell_m() : roughness_->Spacing(0);
  double coarsest_m = cell_m;
  if (model_) {
    bounds_ = model_->bounds();
  }
  if (roughness_) {
    bounds_.height_m += roughness_->bounds().height_m;
    bounds_.slope += roughness_->bounds().slope;
    bounds_.curvature_per_m += roughness_->bounds().curvature_per_m;
    const int finer = std::ilogb(cell_m / roughness_->Spacing(0) * kRoundingUp);
    model_level_ = std::max(0, -finer);
    roughness_level_ = std::max(0, finer);
    coarsest_m = std::ldexp(cell_m, model_level_);
    EXPECT(std::abs(std::ldexp(roughness_->Spacing(0), roughness_level_) / coarsest_m - 1.0) <
           1e-9);
    finest_ = roughness_level_ + roughness_->octaves() - 1;
  }
  if (model_) finest_ = std::max(finest_, model_level_);
  cells_per_m_ = roughness_ && !model_ ? 1.0 / roughness_->Spacing(finest_)
                                       : std::ldexp(1.0, finest_) / coarsest_m;
  if (model_) {
    // The model with two cells around it, from where on it is level.
    const auto page_of = [&](std::int64_t node) {
      return (node * (std::int64_t{1} << (finest_ - model_level_))) >> kPageShift;
    };
    near_.first_column = page_of(model_->first_column() - 2);
    near_.first_row = page_of(model_->first_row() - 2);
    near_.columns = page_of(model_->last_column() + 2) - near_.first_column + 1;
    near_.rows = page_of(model_->last_row() + 2) - near_.first_row + 1;
  } else {
    // The longest octave repeats after 64 nodes, one page, and so does the sum.
    static_assert(RoughnessField::kNodes == kPage);
    near_.columns = std::int64_t{1} << finest_;
    near_.rows = near_.columns;
  }
  pages_ = std::vector<std::atomic<const Page*>>(static_cast<std::size_t>(near_.columns) *
                                                 static_cast<std::size_t>(near_.rows));
}

ReliefSpline::~ReliefSpline() {
  for (const auto& page : pages_) delete page.load();
}

ReliefSpline::Nodes ReliefSpline::NodesOf(int level, std::int64_t page_column,
                                          std::int64_t page_row) const {
  Nodes nodes(std::size_t{kNodes} * kNodes);
  const auto add = [&](const auto& coefficient) {
    double* out = nodes.data();
    for (int row = -1; row < kNodes - 1; ++row) {
      for (int column = -1; column < kNodes - 1; ++column) {
        *out++ += coefficient(page_column * kPage + column, page_row * kPage + row);
      }
    }
  };
  const int octave = level - roughness_level_;
  if (roughness_ && octave >= 0 && octave < roughness_->octaves()) {
    add([&](std::int64_t column, std::int64_t row) {
      return roughness_->Coefficient(octave, column, row);
    });
  }
  if (model_ && level == model_level_) {
    add([this](std::int64_t column, std::int64_t row) { return model_->Coefficient(column, row); });
  }
  if (level == 0) return nodes;
  const Nodes above = NodesOf(level - 1, page_column >> 1, page_row >> 1);
  const std::int64_t left = (page_column & 1) * kPage / 2;
  const std::int64_t down = (page_row & 1) * kPage / 2;
  std::array<double, kNodes> line{};
  double* out = nodes.data();
  for (int row = -1; row < kNodes - 1; ++row) {
    // Arithmetic shift: rounds negative numbers down.
    const double* middle = above.data() + (down + (row >> 1) + 1) * kNodes;
    for (int k = 0; k < kNodes; ++k) {
      line[static_cast<std::size_t>(k)] = Refine(middle + k, kNodes, row);
    }
    for (int column = -1; column < kNodes - 1; ++column) {
      *out++ += Refine(line.data() + left + (column >> 1) + 1, 1, column);
    }
  }
  return nodes;
}

// A polynomial lies within the hull of its control points, and so do its derivatives. Their control
// points are 6 times the second differences along an axis, 9 times the mixed differences.
ReliefSpline::Bounds ReliefSpline::BoundsOf(const Nodes& nodes_m, int column, int row) const {
  std::array<std::array<double, 4>, 4> along{};  // by row of nodes
  for (int i = 0; i < 4; ++i) {
    const double* n = nodes_m.data() + (row + i) * kNodes + column;
    along[static_cast<std::size_t>(i)] = ControlPoints(n[0], n[1], n[2], n[3]);
  }
  std::array<std::array<double, 4>, 4> points{};  // by column, then row
  double height_m = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = ControlPoints(along[0][k], along[1][k], along[2][k], along[3][k]);
    height_m = std::max(height_m, *std::max_element(points[k].begin(), points[k].end()));
  }
  double bend_x = 0.0, bend_y = 0.0, twist = 0.0;
  const auto grow = [](double& bound, double value) { bound = std::max(bound, std::abs(value)); };
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      grow(bend_x, 6.0 * (points[k][i] - 2.0 * points[k + 1][i] + points[k + 2][i]));
      grow(bend_y, 6.0 * (points[i][k] - 2.0 * points[i][k + 1] + points[i][k + 2]));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      grow(twist,
           9.0 * (points[i][k] - points[i + 1][k] - points[i][k + 1] + points[i + 1][k + 1]));
    }
  }
  // The norm of the matrix of second derivatives is no larger than its Frobenius norm.
  const double bend = math::Hypot(math::Hypot(bend_x, bend_y), std::numbers::sqrt2 * twist);
  return {height_m, bend * cells_per_m_ * cells_per_m_};
}

std::unique_ptr<ReliefSpline::Page> ReliefSpline::MakePage(std::int64_t column,
                                                           std::int64_t row) const {
  auto made = std::make_unique<Page>();
  made->nodes_m = NodesOf(finest_, column, row);
  made->highest_m.fill(-std::numeric_limits<double>::infinity());
  for (int y = 0; y < kPage; ++y) {
    for (int x = 0; x < kPage; ++x) {
      const Bounds bounds = BoundsOf(made->nodes_m, x, y);
      made->bounds[PlaceOf(x, y)] = bounds;
      double& highest_m = made->highest_m[BlockOf(x, y)];
      highest_m = std::max(highest_m, bounds.height_m);
    }
  }
  return made;
}

const ReliefSpline::Page& ReliefSpline::FarPage(std::int64_t column, std::int64_t row) const {
  const std::lock_guard lock(far_mutex_);
  std::unique_ptr<const Page>& page = far_pages_[{column, row}];
  if (!page) page = MakePage(column, row);
  return *page;
}

const ReliefSpline::Page& ReliefSpline::PageAt(std::int64_t page_column,
                                               std::int64_t page_row) const {
  std::int64_t column = page_column - near_.first_column;
  std::int64_t row = page_row - near_.first_row;
  if (!model_) {
    column &= near_.columns - 1;
    row &= near_.rows - 1;
  } else if (column < 0 || column >= near_.columns || row < 0 || row >= near_.rows) {
    return FarPage(page_column, page_row);
  }
  auto& place = pages_[static_cast<std::size_t>(row * near_.columns + column)];
  if (const Page* page = place.load(std::memory_order_acquire)) return *page;
  auto made = MakePage(near_.first_column + column, near_.first_row + row);
  // Another thread may have made the same one meanwhile.
  const Page* there = nullptr;
  if (!place.compare_exchange_strong(there, made.get())) return *there;
  return *made.release();
}

ReliefSpline::Cell ReliefSpline::CellAt(std::int64_t column, std::int64_t row) const {
  return {&PageAt(column >> kPageShift, row >> kPageShift), static_cast<int>(column & (kPage - 1)),
          static_cast<int>(row & (kPage - 1))};
}

ReliefSample ReliefSpline::SampleIn(const Cell& cell, double u, double v) const {
  const CellSplines x(u);
  const CellSplines y(v);
  ReliefSample sum;
  // Node -1 is the first of a line.
  const double* line = cell.page->nodes_m.data() + cell.row * kNodes + cell.column;
  for (std::size_t i = 0; i < 4; ++i, line += kNodes) {
    const double value = (x.value[0] * line[0] + x.value[1] * line[1]) +
                         (x.value[2] * line[2] + x.value[3] * line[3]);
    const double slope = (x.slope[0] * line[0] + x.slope[1] * line[1]) +
                         (x.slope[2] * line[2] + x.slope[3] * line[3]);
    sum.height_m += y.value[i] * value;
    sum.slope_x += y.value[i] * slope;
    sum.slope_y += y.slope[i] * value;
  }
  sum.slope_x *= cells_per_m_;
  sum.slope_y *= cells_per_m_;
  return sum;
}

ReliefSample ReliefSpline::Sample(double x_m, double y_m) const {
  const double u = x_m * cells_per_m_;
  const double v = y_m * cells_per_m_;
  const double column = std::floor(u);
  const double row = std::floor(v);
  return SampleIn(CellAt(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)),
                  u - column, v - row);
}

std::optional<double> ReliefSpline::FirstBelow(const SightLine& line, double max_distance_m) const {
  // Above the highest that the relief can be there is nothing to meet.
  const double over = line.height_m - bounds_.height_m;
  if (over > 0.0 && over > line.descent * max_distance_m) return std::nullopt;
  double from = over > 0.0 ? over / line.descent : 0.0;
  const double end = over <= 0.0 && line.descent < 0.0
                         ? std::min(over / line.descent, max_distance_m)
                         : max_distance_m;
  const double x = line.x_m * cells_per_m_;
  const double y = line.y_m * cells_per_m_;
  const double along_x = line.along_x * cells_per_m_;
  const double along_y = line.along_y * cells_per_m_;
  Borders columns(x, along_x, from);
  Borders rows(y, along_y, from);
  const double along2 = line.along_x * line.along_x + line.along_y * line.along_y;
  while (true) {
    const Cell cell = CellAt(columns.cell, rows.cell);
    const auto lowest = [&](double to) {
      return line.height_m - line.descent * (line.descent > 0.0 ? to : from);
    };
    const double out = std::min({columns.BlockEnd(kBlock), rows.BlockEnd(kBlock), end});
    if (lowest(out) > cell.page->highest_m[BlockOf(cell.column, cell.row)]) {
      if (out >= end) return std::nullopt;
      // Both axes go on to the first cell beyond the block.
      while (columns.next < out) columns.Advance();
      while (rows.next < out) rows.Advance();
      (columns.next < rows.next ? columns : rows).Advance();
      from = out;
      continue;
    }
    const double to = std::min({columns.next, rows.next, end});
    const Bounds& bounds = cell.page->bounds[PlaceOf(cell.column, cell.row)];
    if (lowest(to) <= bounds.height_m) {
      const auto at = [&](double t) -> Approach {
        const ReliefSample here =
            SampleIn(cell, x + t * along_x - static_cast<double>(columns.cell),
                     y + t * along_y - static_cast<double>(rows.cell));
        return {line.height_m - t * line.descent - here.height_m,
                line.descent + here.slope_x * line.along_x + here.slope_y * line.along_y};
      };
      const Approach at_from = at(from);
      if (at_from.gap_m <= 0.0) return from;
      // The second derivative along the ray counts the horizontal part twice.
      const double bend_per_m = bounds.curvature_per_m * along2;
      // The gap of a ray that leaves the ground, as towards the sun, opens all the way: no
      // crossing.
      if (at_from.rate > -bend_per_m * (to - from)) {
        if (const auto t = FirstCrossing(at, Part{from, to, at_from, at(to)}, bend_per_m)) return t;
      }
    }
    if (to >= end) return std::nullopt;
    (columns.next < rows.next ? columns : rows).Advance();
    from = to;
  }
}

}  // namespace rockyard::terrain
