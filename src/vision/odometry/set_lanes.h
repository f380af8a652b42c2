// Which lanes of a mask are set, for the search for corners and for features near a place. Highway
// compiles this file once for every instruction set, hence the guard. Only .cc files that have
// included Highway include it. Both forms must write ascending numbers, by which ties are decided.
#if defined(ROCKYARD_VISION_SET_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ROCKYARD_VISION_SET_LANES_H
#undef ROCKYARD_VISION_SET_LANES_H
#else
#define ROCKYARD_VISION_SET_LANES_H
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {

// Writes the numbers of the lanes that are set, counted from `first` on, and returns how many they
// are. `numbers` has room for a whole vector. CompressStore of Highway 1.0 is slower: for AVX-512
// it compresses into memory, for AVX2 GCC copies its table of 1 KiB each time. Its Iota from a
// variable start is slow, too, as it writes lane by lane.
template <class D>
HWY_INLINE std::size_t WriteSetLanes(D lanes, hwy::HWY_NAMESPACE::Mask<D> mask, std::int32_t first,
                                     std::int32_t* numbers) {
#if HWY_TARGET <= HWY_AVX3
  namespace hn = hwy::HWY_NAMESPACE;
  const auto all = hn::Add(hn::Iota(lanes, 0), hn::Set(lanes, first));
  hn::StoreU(hn::Compress(all, mask), lanes, numbers);
  return hn::CountTrue(lanes, mask);
#else
  std::uint8_t bytes[8];
  const std::size_t count = hwy::HWY_NAMESPACE::StoreMaskBits(lanes, mask, bytes);
  std::size_t set = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint32_t bits = bytes[i]; bits != 0; bits &= bits - 1) {
      numbers[set++] = first + static_cast<std::int32_t>(8 * i) + std::countr_zero(bits);
    }
  }
  return set;
#endif
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROCKYARD_VISION_SET_LANES_H
