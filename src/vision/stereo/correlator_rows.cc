// The rows of CorrelateRows (correlator.h): lays pixels into lanes, brings together the best of
// right pixels, and applies the filters to a row.
#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/stereo/correlator_rows.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vision/stereo/correlator.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kPixels;
constexpr hn::RepartitionToWide<decltype(kPixels)> kPairs;  // two neighbouring lanes
constexpr hn::RebindToSigned<decltype(kPairs)> kInts;
constexpr hn::RebindToFloat<decltype(kPairs)> kFloats;
constexpr hn::RebindToSigned<decltype(kPixels)> kResults;
constexpr hn::RepartitionToWide<decltype(kPairs)> kQuads;
constexpr hn::RebindToSigned<decltype(kQuads)> kQuadInts;
using Pixels = hn::Vec<decltype(kPixels)>;
using Ints = hn::Vec<decltype(kInts)>;

// Fills vectors j < 0 and j >= segment with the pixels of the neighbouring lane; `row` is vector 0.
void ExtendRow(const LaneLayout& layout, std::uint16_t* row) {
  const std::ptrdiff_t lanes = layout.lanes;
  const std::ptrdiff_t segment = lanes * layout.segment;
  for (std::ptrdiff_t j = -lanes; j >= lanes * layout.first; j -= lanes) {
    hn::Store(hn::LoadU(kPixels, row + j + segment - 1), kPixels, row + j);
  }
  for (std::ptrdiff_t j = segment; j <= lanes * layout.last; j += lanes) {
    hn::Store(hn::LoadU(kPixels, row + j - segment + 1), kPixels, row + j);
  }
}

// Lays a row of pixels into the lanes: pixel i * segment + j, times four, into lane i of vector j.
// Loads four pixels of a segment as a word of 32 bits, first for even lanes, then for odd ones.
void ToLanes(const std::uint8_t* pixels, const LaneLayout& layout, std::uint16_t* row) {
  const auto* const words = reinterpret_cast<const std::int32_t*>(pixels);
  const auto even = hn::Mul(hn::Iota(kInts, 0), hn::Set(kInts, layout.segment / 2));
  const auto odd = hn::Add(even, hn::Set(kInts, layout.segment / 4));
  const auto low = hn::Set(kPairs, 0xFF << kKeyShift);
  const auto high = hn::ShiftLeft<16>(low);
  const std::ptrdiff_t lanes = layout.lanes;
  for (int word = 0; word < layout.segment / 4; ++word) {
    const auto evens = hn::BitCast(kPairs, hn::GatherIndex(kInts, words + word, even));
    const auto odds = hn::BitCast(kPairs, hn::GatherIndex(kInts, words + word, odd));
    std::uint16_t* const to = row + 4 * word * lanes;
    const auto store = [&](hn::Vec<decltype(kPairs)> e, hn::Vec<decltype(kPairs)> o,
                           std::uint16_t* vector) HWY_ATTR {
      hn::Store(hn::BitCast(kPixels, hn::Or(hn::And(e, low), hn::And(o, high))), kPixels, vector);
    };
    store(hn::ShiftLeft<2>(evens), hn::ShiftLeft<18>(odds), to);
    store(hn::ShiftRight<6>(evens), hn::ShiftLeft<10>(odds), to + lanes);
    store(hn::ShiftRight<14>(evens), hn::ShiftLeft<2>(odds), to + 2 * lanes);
    store(hn::ShiftRight<22>(evens), hn::ShiftRight<6>(odds), to + 3 * lanes);
  }
}

// Does the reverse of ToLanes: takes four vectors, which hold four neighbouring values of each
// segment, and stores those of each segment as a word of 64 bits.
void FromLanes(const std::int16_t* lanes_of_row, const LaneLayout& layout, std::int16_t* row) {
  auto* const words = reinterpret_cast<std::int64_t*>(row);
  const std::ptrdiff_t lanes = layout.lanes;
  const std::int64_t segment = layout.segment / 4;
  const auto quad = hn::Mul(hn::Iota(kQuadInts, 0), hn::Set(kQuadInts, 4 * segment));
  const auto last = hn::Set(kQuads, std::uint64_t{0xFFFF} << 48);
  for (std::int64_t word = 0; word < segment; ++word) {
    const std::int16_t* const from = lanes_of_row + 4 * word * lanes;
    const auto load = [&](std::ptrdiff_t j) HWY_ATTR {
      return hn::BitCast(kQuads, hn::Load(kResults, from + j * lanes));
    };
    const auto v0 = load(0), v1 = load(1), v2 = load(2), v3 = load(3);
    const auto first = hn::Set(kQuads, 0xFFFF);
    const auto second = hn::ShiftLeft<16>(first);
    const auto third = hn::ShiftLeft<32>(first);
    const auto scatter = [&](hn::Vec<decltype(kQuads)> a, hn::Vec<decltype(kQuads)> b,
                             hn::Vec<decltype(kQuads)> c, hn::Vec<decltype(kQuads)> d,
                             std::int64_t lane) HWY_ATTR {
      const auto all = hn::Or(hn::Or(hn::And(a, first), hn::And(b, second)),
                              hn::Or(hn::And(c, third), hn::And(d, last)));
      const auto at = hn::Add(quad, hn::Set(kQuadInts, lane * segment));
      hn::ScatterIndex(hn::BitCast(kQuadInts, all), kQuadInts, words + word, at);
    };
    scatter(v0, hn::ShiftLeft<16>(v1), hn::ShiftLeft<32>(v2), hn::ShiftLeft<48>(v3), 0);
    scatter(hn::ShiftRight<16>(v0), v1, hn::ShiftLeft<16>(v2), hn::ShiftLeft<32>(v3), 1);
    scatter(hn::ShiftRight<32>(v0), hn::ShiftRight<16>(v1), v2, hn::ShiftLeft<16>(v3), 2);
    scatter(hn::ShiftRight<48>(v0), hn::ShiftRight<32>(v1), hn::ShiftRight<16>(v2), v3, 3);
  }
}

// For each right pixel of one vector: the best match so far, as its key and group of disparities.
struct RightBest {
  Pixels key;
  Pixels group;
};

HWY_INLINE RightBest LoadBest(const std::uint16_t* keys, const std::uint16_t* groups,
                              std::ptrdiff_t at) {
  return {hn::LoadU(kPixels, keys + at), hn::LoadU(kPixels, groups + at)};
}

// Merges what pixels found outside of their own segment into it, from the farthest vector inwards.
// Must stay, for the smallest disparity of equal scores: vectors before the segment, which hold
// larger disparities, lose ties; vectors behind it, which hold smaller ones, win ties.
void MergeBest(const LaneLayout& layout, std::uint16_t* keys, std::uint16_t* groups) {
  const std::ptrdiff_t lanes = layout.lanes;
  const std::ptrdiff_t segment = lanes * layout.segment;
  const auto place = hn::Set(kPixels, kGroup - 1);
  const auto none = hn::Set(kPixels, kNoKey);
  const auto lane = hn::Iota(kPixels, 0);
  const auto first_lane = hn::Eq(lane, hn::Zero(kPixels));
  const auto last_lane = hn::Eq(lane, hn::Set(kPixels, static_cast<std::uint16_t>(lanes - 1)));
  const auto store = [&](const RightBest& best, std::ptrdiff_t at) HWY_ATTR {
    hn::Store(best.key, kPixels, keys + at);
    hn::Store(best.group, kPixels, groups + at);
  };
  for (std::ptrdiff_t j = lanes * layout.first; j < 0; j += lanes) {
    RightBest here = LoadBest(keys, groups, j + segment);
    const RightBest other = LoadBest(keys, groups, j + 1);
    const auto key = hn::IfThenElse(last_lane, none, other.key);
    const auto better = hn::Lt(hn::Or(key, place), here.key);
    here = {hn::IfThenElse(better, key, here.key), hn::IfThenElse(better, other.group, here.group)};
    store(here, j + segment);
  }
  for (std::ptrdiff_t j = lanes * layout.last; j >= segment; j -= lanes) {
    const RightBest here = LoadBest(keys, groups, j - segment);
    RightBest best = LoadBest(keys, groups, j - 1);
    best.key = hn::IfThenElse(first_lane, none, best.key);
    const auto worse = hn::Lt(hn::Or(here.key, place), best.key);
    best = {hn::IfThenElse(worse, here.key, best.key),
            hn::IfThenElse(worse, here.group, best.group)};
    store(best, j - segment);
  }
}

// Returns the disparity that a key and its group stand for, less the smallest of the range.
HWY_INLINE Pixels DisparityIndex(Pixels key, Pixels group) {
  return hn::Add(hn::ShiftLeft<kKeyShift>(group), hn::And(key, hn::Set(kPixels, kGroup - 1)));
}

void GatherRightBest(CorrelatorState& state) {
  const LaneLayout& layout = state.layout;
  const std::ptrdiff_t zero = layout.Wide(0);
  std::uint16_t* const keys = state.right_key.data() + zero;
  std::uint16_t* const groups = state.right_group.data() + zero;
  std::uint16_t* const index = state.right_index.data() + zero;
  MergeBest(layout, keys, groups);
  const std::ptrdiff_t lanes = layout.lanes;
  for (std::ptrdiff_t j = 0; j < lanes * layout.segment; j += lanes) {
    const RightBest best = LoadBest(keys, groups, j);
    hn::Store(DisparityIndex(best.key, best.group), kPixels, index + j);
  }
  ExtendRow(layout, index);
}

// Return one of the two lanes of each pair, as a number of 32 bits.
struct EvenLanes {
  Ints operator()(Ints pairs) const { return hn::And(pairs, hn::Set(kInts, 0xFFFF)); }
};
struct OddLanes {
  Ints operator()(Ints pairs) const {
    return hn::BitCast(kInts, hn::ShiftRight<16>(hn::BitCast(kPairs, pairs)));
  }
};

// Where the words of vector j lie for each pair of lanes, counted in pairs.
struct PairTables {
  const std::int32_t* scores;       // of the smallest disparity
  std::int32_t score_stride;        // to the next disparity
  const std::int32_t* right_index;  // of the match at the smallest disparity
  std::int32_t right_stride;        // back to the match at the next disparity
};

HWY_INLINE Ints Replace(hn::Mask<decltype(kInts)> dropped, Drop reason, Ints value) {
  return hn::IfThenElse(dropped, hn::Set(kInts, Dropped(reason)), value);
}

// Returns floor((32 (below - above) + 33 m) / (2 m)) - 16 as SubPixel (correlator.h) does, to the
// bit. Numerator and denominator are whole numbers below 2^24, exact as floats, and their ratio is
// below 64. A ratio that is not whole is 1 / 65532 or more below the next whole number, which is
// twice the spacing of floats there, so that rounding cannot reach that number.
HWY_INLINE Ints SubPixelOf(Ints below, Ints above, Ints steepness) {
  const auto numerator = hn::Add(hn::Mul(hn::Sub(below, above), hn::Set(kInts, kDisparityOne)),
                                 hn::Mul(steepness, hn::Set(kInts, kDisparityOne + 1)));
  const auto denominator = hn::Max(hn::Add(steepness, steepness), hn::Set(kInts, 1));
  const auto ratio =
      hn::Div(hn::ConvertTo(kFloats, numerator), hn::ConvertTo(kFloats, denominator));
  return hn::Sub(hn::ConvertTo(kInts, ratio), hn::Set(kInts, kDisparityOne / 2));
}

// Returns the disparity or the drop of one half of the lanes, the even or the odd ones. `x` is the
// right pixel at the smallest disparity.
template <typename Half>
HWY_INLINE Ints Decide(Ints keys, Ints indices, Ints x, const PairTables& tables,
                       const LaneLayout& layout, const PeakLimits& limits) {
  const Half half;
  const auto key = half(keys);
  const auto index = half(indices);
  const auto pair = hn::Iota(kInts, 0);
  const auto match = hn::Sub(pair, hn::Mul(index, hn::Set(kInts, tables.right_stride)));
  const auto back = half(hn::GatherIndex(kInts, tables.right_index, match));
  const auto stride = hn::Set(kInts, tables.score_stride);
  const auto at = hn::Add(pair, hn::Mul(index, stride));
  const auto below =
      hn::ShiftRight<kKeyShift>(half(hn::GatherIndex(kInts, tables.scores, hn::Sub(at, stride))));
  const auto above =
      hn::ShiftRight<kKeyShift>(half(hn::GatherIndex(kInts, tables.scores, hn::Add(at, stride))));
  const auto best = hn::ShiftRight<kKeyShift>(key);

  const auto curvature = hn::Sub(hn::Add(below, above), hn::Add(best, best));
  const auto whole = hn::Add(index, hn::Set(kInts, layout.min_disparity));
  const auto steepness = limits.interpolation == Interpolation::kQuadratic
                             ? curvature
                             : hn::Sub(hn::Max(below, above), best);
  auto value =
      hn::Add(hn::ShiftLeft<kDisparityFractionBits>(whole), SubPixelOf(below, above, steepness));

  const auto contrast =
      hn::Lt(hn::ShiftLeft<8>(curvature), hn::Mul(best, hn::Set(kInts, limits.ratio_256)));
  const auto peak = hn::AndNot(hn::Lt(curvature, hn::Set(kInts, limits.curvature)),
                               hn::Gt(hn::Min(below, above), best));
  // range_end: the match is the first or last candidate of the pixel.
  const auto right = hn::Sub(x, index);
  const auto first = hn::Or(hn::Eq(index, hn::Zero(kInts)),
                            hn::Eq(right, hn::Set(kInts, layout.width - 1 - layout.after)));
  const auto last = hn::Or(hn::Eq(index, hn::Set(kInts, layout.disparities - 1)),
                           hn::Eq(right, hn::Set(kInts, layout.before)));
  const auto range_end = hn::Or(first, last);
  const auto line_of_sight =
      hn::Gt(hn::Abs(hn::Sub(back, index)), hn::Set(kInts, limits.line_of_sight));
  // The first filter that a pixel fails must name the drop, and so is written last.
  value = Replace(contrast, Drop::kContrast, value);
  value = Replace(hn::Not(peak), Drop::kPeak, value);
  value = Replace(range_end, Drop::kRangeEnd, value);
  value = Replace(line_of_sight, Drop::kLineOfSight, value);
  return Replace(hn::Eq(key, hn::Set(kInts, kNoKey)), Drop::kOutside, value);
}

void DecideRow(const PeakLimits& limits, CorrelatorState& state) {
  const LaneLayout& layout = state.layout;
  const std::ptrdiff_t lanes = layout.lanes;
  PairTables tables{reinterpret_cast<const std::int32_t*>(state.Scores(0)),
                    static_cast<std::int32_t>(layout.row_size() / 2),
                    reinterpret_cast<const std::int32_t*>(state.right_index.data() +
                                                          layout.Wide(-layout.min_disparity)),
                    layout.lanes / 2};
  auto x = hn::Sub(hn::Mul(hn::Iota(kInts, 0), hn::Set(kInts, 2 * layout.segment)),
                   hn::Set(kInts, layout.min_disparity));
  for (std::ptrdiff_t j = 0; j < lanes * layout.segment; j += lanes) {
    const auto key = hn::Load(kPixels, state.left_key.data() + j);
    const auto index = DisparityIndex(key, hn::Load(kPixels, state.left_group.data() + j));
    const auto keys = hn::BitCast(kInts, key);
    const auto indices = hn::BitCast(kInts, index);
    const auto even = Decide<EvenLanes>(keys, indices, x, tables, layout, limits);
    const auto odd = Decide<OddLanes>(keys, indices, hn::Add(x, hn::Set(kInts, layout.segment)),
                                      tables, layout, limits);
    const auto both = hn::Or(hn::And(even, hn::Set(kInts, 0xFFFF)), hn::ShiftLeft<16>(odd));
    hn::Store(hn::BitCast(kResults, both), kResults, state.result.data() + j);
    x = hn::Add(x, hn::Set(kInts, 1));
    tables.scores += lanes / 2;
    tables.right_index += lanes / 2;
  }
  FromLanes(state.result.data(), layout, state.row.data());
}

// Lays a row of the right image into lanes, as far as disparities reach.
void ToWideLanes(const std::uint8_t* pixels, const LaneLayout& layout, std::uint16_t* row) {
  ToLanes(pixels, layout, row);
  ExtendRow(layout, row);
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(ToLanes);
HWY_EXPORT(ToWideLanes);
HWY_EXPORT(GatherRightBest);
HWY_EXPORT(DecideRow);

void LoadRow(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int slot,
             CorrelatorState& state) {
  std::copy(left.begin(), left.end(), state.pixels.data());
  HWY_DYNAMIC_DISPATCH(ToLanes)(state.pixels.data(), state.layout, state.Left(slot));
  std::copy(right.begin(), right.end(), state.pixels.data());
  HWY_DYNAMIC_DISPATCH(ToWideLanes)
  (state.pixels.data(), state.layout, state.Right(slot) + state.layout.Wide(0));
}

void GatherRightBest(CorrelatorState& state) { HWY_DYNAMIC_DISPATCH(GatherRightBest)(state); }

void DecideRow(const PeakLimits& limits, CorrelatorState& state) {
  HWY_DYNAMIC_DISPATCH(DecideRow)(limits, state);
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
