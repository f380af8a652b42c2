// Sums of eight absolute differences of bytes, for windows and bounds of their differences. Highway
// compiles this file once for every instruction set, hence the guard. Only .cc files that have
// included Highway include it.
#if defined(ROCKYARD_VISION_SUMS_OF_DIFFERENCES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ROCKYARD_VISION_SUMS_OF_DIFFERENCES_H
#undef ROCKYARD_VISION_SUMS_OF_DIFFERENCES_H
#else
#define ROCKYARD_VISION_SUMS_OF_DIFFERENCES_H
#endif

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {

// Returns the sum of each eight bytes of whole vectors in a word of 64 bits. x86 has an instruction
// for it, which this version of Highway does not know; the form for other instruction sets must
// give the same sums.
template <class Bytes>
HWY_INLINE auto SumsOf8Differences(Bytes a, Bytes b) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return hn::Vec512<std::uint64_t>{_mm512_sad_epu8(a.raw, b.raw)};
#elif HWY_TARGET == HWY_AVX2
  return hn::Vec256<std::uint64_t>{_mm256_sad_epu8(a.raw, b.raw)};
#elif HWY_TARGET == HWY_SSE4
  return hn::Vec128<std::uint64_t>{_mm_sad_epu8(a.raw, b.raw)};
#else
  // One of the two differences is 0.
  return hn::SumsOf8(hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)));
#endif
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROCKYARD_VISION_SUMS_OF_DIFFERENCES_H
