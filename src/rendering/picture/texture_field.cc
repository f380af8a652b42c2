#include "rendering/picture/texture_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "math/functions.h"
#include "rendering/image_readout.h"

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

// Returns log2 of a positive number by its chords between powers of two: enough to fade by. Must
// stay free of libm, so that images have the same bits on every machine.
double ChordLog2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kFraction = (1ULL << 52) - 1;
  const auto exponent = static_cast<int>(bits >> 52) - 1023;
  const double mantissa = std::bit_cast<double>((bits & kFraction) | (1023ULL << 52));  // in [1, 2)
  return exponent + mantissa - 1.0;
}

// A square of nodes in and around a page. What it holds at first is not defined.
struct Square {
  Square(int first_node, int nodes)
      : first(first_node),
        size(nodes),
        values(std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(nodes) * nodes)) {}
  // Node (column, row) is Row(row)[column - first].
  float* Row(int row) const { return values.get() + static_cast<std::size_t>(row - first) * size; }
  int first;
  int size;
  std::unique_ptr<float[]> values;
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

// Returns D along one axis at a node, from nodes `stride` apart.
inline float LowPass(const float* from, std::ptrdiff_t stride) {
  constexpr float kSixteenth = 1.0F / 16.0F;
  return kSixteenth *
         (10.0F * from[0] + 5.0F * (from[-stride] + from[stride]) -
          (from[-2 * stride] + from[2 * stride]) - (from[-3 * stride] + from[3 * stride]));
}

// Returns D of the nodes in and around a page: first along columns, of every other row, then along
// rows, of every other column.
Square ThinnedOut(Square& fine, int coarse_first, int coarse_size) {
  Square coarse(coarse_first, coarse_size);
  Square line(fine.first, fine.size);
  for (int row = coarse_first; row < coarse_first + coarse_size; ++row) {
    const float* from = fine.Row(2 * row);
    float* thin = line.Row(line.first);
    for (int k = 0; k < fine.size; ++k) thin[k] = LowPass(from + k, fine.size);
    float* out = coarse.Row(row);
    const float* first = thin + 2 * coarse_first - fine.first;
    for (int k = 0; k < coarse_size; ++k) out[k] = LowPass(first + 2 * k, 1);
  }
  return coarse;
}

// Returns U of coarse nodes, at the fine nodes first .. last - 1 of both axes. `first` must be odd
// and `last` even.
Square Refined(Square& coarse, int first, int last) {
  // Along one axis, from the coarse nodes on both sides of a fine one and from the next.
  const auto on_node = [](float left, float here, float right) {
    return 0.125F * (left + 6.0F * here + right);
  };
  const auto between = [](float here, float right) { return 0.5F * (here + right); };
  Square fine(first, last - first);
  Square line(coarse.first, coarse.size);
  const auto size = static_cast<std::ptrdiff_t>(coarse.size);
  for (int row = first; row < last; ++row) {
    // Arithmetic shift: rounds negative numbers down.
    const float* middle = coarse.Row(row >> 1);
    float* refined = line.Row(line.first);
    if ((row & 1) == 0) {
      for (std::ptrdiff_t k = 0; k < size; ++k) {
        refined[k] = on_node(middle[k - size], middle[k], middle[k + size]);
      }
    } else {
      for (std::ptrdiff_t k = 0; k < size; ++k) refined[k] = between(middle[k], middle[k + size]);
    }
    float* out = fine.Row(row);
    const float* in = refined + (first >> 1) - coarse.first;
    *out++ = between(in[0], in[1]);
    for (int i = (last - first - 1) / 2; i > 0; --i, out += 2) {
      ++in;
      out[0] = on_node(in[-1], in[0], in[1]);
      out[1] = between(in[0], in[1]);
    }
  }
  return fine;
}

}  // namespace

TextureField::TextureField(const TextureParams& texture, core::TrialKey key, core::Purpose purpose,
                           int most_taps)
    : key_(key), purpose_(purpose), most_taps_(most_taps) {
  EXPECT(most_taps >= 1);
  EXPECT(texture.finest_wavelength_m > 0.0 &&
         texture.longest_wavelength_m >= texture.finest_wavelength_m);
  double sum = 0.0;
  for (double wavelength_m = texture.longest_wavelength_m;
       wavelength_m >= texture.finest_wavelength_m * (1.0 - 1e-9); wavelength_m *= 0.5) {
    spacings_m_.push_back(wavelength_m / kNodesPerWavelength);
    // A spectrum f^-e holds 2 pi f^(1-e) df: an octave in proportion to wavelength^(e - 2).
    const double octave = static_cast<double>(spacings_m_.size() - 1);
    amplitudes_.push_back(math::Exp2(-octave * (texture.spectral_exponent - 2.0)));
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
  const PixelNoise noise(key_, purpose_, static_cast<std::uint32_t>(place.octave));
  constexpr int kFirst = -1;
  constexpr int kSize = kStored - 1;
  Square numbers = NumbersAround(noise, place.column * kPage, place.row * kPage, kPage);
  Square coarse = ThinnedOut(numbers, -2, kPage / 2 + 4);
  Square low = Refined(coarse, kFirst, kFirst + kSize);
  auto page = std::make_unique_for_overwrite<Page>();
  const auto amplitude = static_cast<float>(amplitudes_[static_cast<std::size_t>(place.octave)]);
  for (int row = kFirst; row < kFirst + kSize; ++row) {
    const float* high = numbers.Row(row) + kFirst - numbers.first;
    float* out = page->octave.data() + (row - kFirst) * kStored;
    for (int k = 0; k < kSize; ++k) out[k] = amplitude * (high[k] - low.Row(row)[k]);
  }
  if (place.octave == 0) {
    page->coarser.fill(0.0F);
  } else {
    AddParent(PageAt({place.octave - 1, place.column >> 1, place.row >> 1}), place, *page);
  }
  return *(pages_[place.Key()] = std::move(page));
}

// Fills page.coarser: refines what the page over this one, of the next coarser octave, holds.
void TextureField::AddParent(const Page& parent, const Place& place, Page& page) {
  const int left = static_cast<int>(place.column & 1) * kPage / 2;
  const int down = static_cast<int>(place.row & 1) * kPage / 2;
  Square above(-1, kPage / 2 + 3);
  for (int row = -1; row < kPage / 2 + 2; ++row) {
    const int first = (row + down + 1) * kStored + left;
    float* to = above.Row(row);
    for (int k = 0; k < above.size; ++k) {
      const std::size_t node = static_cast<std::size_t>(first) + static_cast<std::size_t>(k);
      to[k] = parent.coarser[node] + parent.octave[node];
    }
  }
  Square refined = Refined(above, -1, kPage + 2);
  for (int row = -1; row < kPage + 2; ++row) {
    std::copy_n(refined.Row(row), refined.size, page.coarser.data() + (row + 1) * kStored);
  }
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
  // No narrower than what most_taps_ can cover.
  const double per_width = 1.0 / std::max({ellipse.width_m, ellipse.length_m / most_taps_, 1e-9});
  // The share of octave j is full - j between 0 and 1.
  const double full = ChordLog2(spacings_m_.front() / kHalfFaded * per_width) + 0.5;
  if (full <= 0.0) return {};
  // Rounded up from a quarter.
  const auto taps =
      std::clamp<std::int64_t>(WholeBelow(ellipse.length_m * per_width + 0.75), 1, most_taps_);
  const int finest = std::min(static_cast<int>(full), octaves() - 1);
  return Taps({finest, std::min(full - finest, 1.0), static_cast<int>(taps)}, u_m, v_m, ellipse);
}

}  // namespace rockyard::rendering
