#include "rendering/picture/texture_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "core/check.h"
#include "rendering/pixel_noise.h"

namespace rockyard::rendering {
namespace {

// Variance of an octave and of its slope along an axis, in 1/spacing^2, for normal numbers of unit
// variance at the nodes: with G_k = int B(x) B(x + k) dx, T = U D along one axis, t the mean of
// sum_k T_(i,i+k) G_k over even and odd i, q that of sum_k (T T^t)_(i,i+k) G_k,
//   variance = G_0^2 - 2 t^2 + q^2;
// for the slope one of each two factors has the derivatives of B in place of B.
constexpr double kOctaveVariance = 0.10649478800382683;
constexpr double kSlopeVariance = 0.2500201114271053;

// Octave j lies on nodes a third of its wavelength apart, in the middle of the wavelengths 2 s to
// 4.5 s that hold nearly all of its power.
constexpr double kNodesPerWavelength = 3.0;
// The largest spacing, over the width of a pixel, at which an octave is half faded: there the mean
// over a square pixel takes half of it away.
constexpr double kHalfFaded = 0.6;

// Four neighbouring nodes of a row, or their weights.
using Four = float __attribute__((vector_size(16)));

Four LoadFour(const float* first) {
  Four four;
  std::memcpy(&four, first, sizeof(four));
  return four;
}

float SumOf(const Four& x) { return (x[0] + x[1]) + (x[2] + x[3]); }

// Weights of the four cubic B-splines over a cell at t in [0, 1), and their derivatives by t:
//   (1 - t)^3 / 6,  (4 - 6 t^2 + 3 t^3) / 6,  (1 + 3 t + 3 t^2 - 3 t^3) / 6,  t^3 / 6.
struct CellWeights {
  explicit CellWeights(float t) {
    constexpr float kSixth = 1.0F / 6.0F;
    const Four constant = Four{1.0F, 4.0F, 1.0F, 0.0F} * kSixth;
    const Four linear = Four{-3.0F, 0.0F, 3.0F, 0.0F} * kSixth;
    const Four square = Four{3.0F, -6.0F, 3.0F, 0.0F} * kSixth;
    const Four cube = Four{-1.0F, 3.0F, -3.0F, 1.0F} * kSixth;
    value = constant + t * (linear + t * (square + t * cube));
    slope = linear + t * (2.0F * square + 3.0F * t * cube);
  }
  Four value;
  Four slope;
};

// The largest whole number up to x. (std::floor is a call where processors need not have it.)
std::int64_t WholeBelow(double x) {
  const auto cut = static_cast<std::int64_t>(x);
  return cut - (static_cast<double>(cut) > x ? 1 : 0);
}

// log2 of a positive number by its chords between powers of two: enough to fade by, and the same
// on every machine.
double ChordLog2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kFraction = (1ULL << 52) - 1;
  const auto exponent = static_cast<int>(bits >> 52) - 1023;
  const double mantissa = std::bit_cast<double>((bits & kFraction) | (1023ULL << 52));  // in [1, 2)
  return exponent + mantissa - 1.0;
}

// A square of nodes around a page.
struct Square {
  Square(int first_node, int nodes)
      : first(first_node), size(nodes), values(static_cast<std::size_t>(nodes) * nodes) {}
  float* Row(int row) { return values.data() + static_cast<std::size_t>(row - first) * size; }
  // Node (column, row) is Row(row)[column - first].
  int first;
  int size;
  std::vector<float> values;
};

constexpr int kReach = 8;  // nodes beside a page whose numbers its octave depends on, rounded up

// The normal numbers of the nodes in and around a page.
Square NumbersAround(const PixelNoise& noise, std::int64_t column0, std::int64_t row0, int page) {
  Square square(-kReach, page + 2 * kReach);
  for (int row = -kReach; row < page + kReach; ++row) {
    // Lattices are as large as 16 bits of row and of block can count, from -2^15, and then repeat.
    const auto wrapped = static_cast<std::int16_t>(row0 + row);
    float* out = square.Row(row);
    for (int column = 0; column < square.size; column += PixelNoise::kBlock) {
      const auto block =
          static_cast<std::int16_t>((column0 - kReach + column) / PixelNoise::kBlock);
      const auto numbers = noise.Block(wrapped, block);
      std::copy(numbers.begin(), numbers.end(), out + column);
    }
  }
  return square;
}

// D: every other node of a line of `count` results, from[0] the first one's own.
void ThinOut(const float* from, std::ptrdiff_t stride, int count, float* to,
             std::ptrdiff_t to_stride) {
  constexpr float kSixteenth = 1.0F / 16.0F;
  for (int i = 0; i < count; ++i, from += 2 * stride, to += to_stride) {
    *to = kSixteenth *
          (10.0F * from[0] + 5.0F * (from[-stride] + from[stride]) -
           (from[-2 * stride] + from[2 * stride]) - (from[-3 * stride] + from[3 * stride]));
  }
}

// U along one axis: the value at fine node i from coarse nodes, coarse[0] that of i / 2 rounded
// down.
inline float Refine(const float* coarse, std::ptrdiff_t stride, int i) {
  return (i & 1) == 0 ? 0.125F * (coarse[-stride] + 6.0F * coarse[0] + coarse[stride])
                      : 0.5F * (coarse[0] + coarse[stride]);
}

// Adds U of a coarse square to the fine nodes first .. last - 1 of both axes, times `factor`.
void AddRefined(Square& coarse, int first, int last, float factor, Square& fine) {
  std::vector<float> line(static_cast<std::size_t>(coarse.size));
  for (int row = first; row < last; ++row) {
    // Arithmetic shift: rounds negative numbers down.
    const float* middle = coarse.Row(row >> 1);
    for (int k = 0; k < coarse.size; ++k) {
      line[static_cast<std::size_t>(k)] = factor * Refine(middle + k, coarse.size, row);
    }
    float* out = fine.Row(row) - fine.first;
    const float* in = line.data() - coarse.first;
    for (int column = first; column < last; ++column) {
      out[column] += Refine(in + (column >> 1), 1, column);
    }
  }
}

}  // namespace

TextureField::TextureField(const TextureParams& texture, core::TrialKey key, core::Purpose purpose)
    : key_(key), purpose_(purpose) {
  EXPECT(texture.finest_wavelength_m > 0.0 &&
         texture.longest_wavelength_m >= texture.finest_wavelength_m);
  double sum = 0.0;
  for (double wavelength_m = texture.longest_wavelength_m;
       wavelength_m >= texture.finest_wavelength_m * (1.0 - 1e-9); wavelength_m *= 0.5) {
    spacings_m_.push_back(wavelength_m / kNodesPerWavelength);
    // A spectrum f^-e holds 2 pi f^(1-e) df: an octave in proportion to wavelength^(e - 2).
    const double octave = static_cast<double>(spacings_m_.size() - 1);
    amplitudes_.push_back(std::exp2(-octave * (texture.spectral_exponent - 2.0)));
    sum += amplitudes_.back();
  }
  for (double& amplitude : amplitudes_) amplitude = std::sqrt(amplitude / (sum * kOctaveVariance));
  latest_.assign(amplitudes_.size(), {});
}

double TextureField::SlopeDeviation() const {
  double sum = 0.0;
  for (std::size_t j = 0; j < amplitudes_.size(); ++j) {
    const double per_m = amplitudes_[j] / spacings_m_[j];
    sum += per_m * per_m * kSlopeVariance;
  }
  return std::sqrt(sum);
}

void TextureField::Trim() {
  constexpr std::size_t kMostPages = 1800;
  if (pages_.size() <= kMostPages) return;
  pages_.clear();
  latest_.assign(amplitudes_.size(), {});
}

const TextureField::Page& TextureField::FindPage(const Place& place) {
  const std::uint64_t key = place.Key();
  const auto found = pages_.find(key);
  const Page& page = found != pages_.end() ? *found->second : MakePage(place);
  latest_[static_cast<std::size_t>(place.octave)] = {key, &page};
  return page;
}

const TextureField::Page& TextureField::MakePage(const Place& place) {
  const auto octave = static_cast<std::size_t>(place.octave);
  const PixelNoise noise(key_, purpose_, static_cast<std::uint32_t>(place.octave));
  Square fine = NumbersAround(noise, place.column * kPage, place.row * kPage, kPage);
  // D N on every other node, columns first.
  constexpr int kCoarseFirst = -2;
  constexpr int kCoarse = kPage / 2 + 4;
  Square half(fine.first, fine.size);
  Square coarse(kCoarseFirst, kCoarse);
  for (int row = fine.first; row < fine.first + fine.size; ++row) {
    ThinOut(fine.Row(row) + 2 * kCoarseFirst - fine.first, 1, kCoarse, half.Row(row), 1);
  }
  for (int k = 0; k < kCoarse; ++k) {
    ThinOut(half.Row(2 * kCoarseFirst) + k, half.size, kCoarse, coarse.values.data() + k, kCoarse);
  }
  constexpr int kFirst = -1;
  constexpr int kLast = kPage + 2;
  AddRefined(coarse, kFirst, kLast, -1.0F, fine);
  const auto amplitude = static_cast<float>(amplitudes_[octave]);
  for (float& value : fine.values) value *= amplitude;
  auto page = std::make_unique_for_overwrite<Page>();
  const auto store = [&page](Square& from, std::span<float> to) {
    for (int row = kFirst; row < kLast; ++row) {
      const float* line = from.Row(row) + kFirst - from.first;
      std::copy(line, line + (kLast - kFirst), to.data() + (row - kFirst) * kStored);
    }
  };
  store(fine, page->octave);
  Square refined(kFirst, kLast - kFirst);
  if (place.octave > 0) {
    const Page& parent = PageAt({place.octave - 1, place.column >> 1, place.row >> 1});
    const int left = static_cast<int>(place.column & 1) * kPage / 2;
    const int down = static_cast<int>(place.row & 1) * kPage / 2;
    Square above(-1, kPage / 2 + 3);
    for (int row = -1; row < kPage / 2 + 2; ++row) {
      const int first = (row + down + 1) * kStored + left;
      float* to = above.Row(row);
      for (int k = 0; k < above.size; ++k) {
        const auto node = static_cast<std::size_t>(first + k);
        to[k] = parent.coarser[node] + parent.octave[node];
      }
    }
    AddRefined(above, kFirst, kLast, 1.0F, refined);
  }
  store(refined, page->coarser);
  return *(pages_[place.Key()] = std::move(page));
}

TextureSample TextureField::Taps(const Level& level, double u_m, double v_m,
                                 const Footprint::Ellipse& ellipse) {
  const double per_m = 1.0 / spacing_m(level.octave);
  // The taps share the length evenly.
  const double step = ellipse.length_m * per_m / level.taps;
  const double step_u = step * ellipse.long_axis.x();
  const double step_v = step * ellipse.long_axis.y();
  const double middle = 0.5 * (level.taps - 1);
  const double first_u = u_m * per_m - middle * step_u;
  const double first_v = v_m * per_m - middle * step_v;
  const auto page_at = [&](double u, double v) {
    static_assert(kPage == 1 << 6);
    return Place{level.octave, WholeBelow(u) >> 6, WholeBelow(v) >> 6};
  };
  // Most footprints lie in one page, as their ends do.
  const Place place = page_at(first_u, first_v);
  const Place last = page_at(first_u + 2.0 * middle * step_u, first_v + 2.0 * middle * step_v);
  const Page* const only_page = place.Key() == last.Key() ? &PageAt(place) : nullptr;
  const auto share = static_cast<float>(level.share);
  Four value{};
  Four slope_u{};
  Four slope_v{};
  for (int i = 0; i < level.taps; ++i) {
    const double u = first_u + i * step_u;
    const double v = first_v + i * step_v;
    const std::int64_t column = WholeBelow(u);
    const std::int64_t row = WholeBelow(v);
    const Page& page = only_page != nullptr ? *only_page : PageAt(page_at(u, v));
    // The splines that reach into a cell stand on the nodes -1 to 2 of it.
    const std::int64_t corner = (row & (kPage - 1)) * kStored + (column & (kPage - 1));
    const auto nodes = [&page, corner, share](int line) {
      const std::int64_t first = corner + line * kStored;
      return LoadFour(page.coarser.data() + first) + share * LoadFour(page.octave.data() + first);
    };
    const CellWeights wu(static_cast<float>(u - static_cast<double>(column)));
    const CellWeights wv(static_cast<float>(v - static_cast<double>(row)));
    const Four a = nodes(0);
    const Four b = nodes(1);
    const Four c = nodes(2);
    const Four d = nodes(3);
    const Four across = wv.value[0] * a + wv.value[1] * b + wv.value[2] * c + wv.value[3] * d;
    const Four down = wv.slope[0] * a + wv.slope[1] * b + wv.slope[2] * c + wv.slope[3] * d;
    value += wu.value * across;
    slope_u += wu.slope * across;
    slope_v += wu.value * down;
  }
  const double weight = 1.0 / level.taps;
  return {weight * SumOf(value), weight * per_m * SumOf(slope_u), weight * per_m * SumOf(slope_v)};
}

TextureSample TextureField::Mean(double u_m, double v_m, const Footprint& footprint) {
  const Footprint::Ellipse ellipse = footprint.Axes();
  // A footprint that is not a number, or far too large for any octave, sees the mean.
  if (!(ellipse.length_m < 1e3 * spacings_m_.front())) return {};
  // No narrower than what kMostTaps can cover.
  const double width_m = std::max({ellipse.width_m, ellipse.length_m / kMostTaps, 1e-9});
  // The share of octave j is full - j between 0 and 1.
  const double full = ChordLog2(spacings_m_.front() / (kHalfFaded * width_m)) + 0.5;
  if (full <= 0.0) return {};
  const int taps =
      std::clamp(static_cast<int>(std::ceil(ellipse.length_m / width_m - 0.25)), 1, kMostTaps);
  const int finest = std::min(static_cast<int>(full), octaves() - 1);
  return Taps({finest, std::min(full - finest, 1.0), taps}, u_m, v_m, ellipse);
}

}  // namespace rockyard::rendering
