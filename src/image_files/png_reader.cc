// DecodePng (png_file.h), by libpng: how errors come back, and what is refused before memory is
// taken.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include "image_files/png_file.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

// What the callbacks of libpng reach. No object with a destructor lives between a setjmp and the
// longjmp that an error of libpng ends with.
struct PngSource {
  std::string_view rest;  // not read yet
  bool ended = false;     // more was asked for than there is
  std::array<char, 256> message{};
};

void ReadBytes(png_structp png, png_bytep to, std::size_t count) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source.rest.size()) {
    source.ended = true;
    png_error(png, "ends early");
  }
  std::memcpy(to, source.rest.data(), count);
  source.rest.remove_prefix(count);
}

[[noreturn]] void KeepError(png_structp png, png_const_charp message) {
  auto& source = *static_cast<PngSource*>(png_get_error_ptr(png));
  std::snprintf(source.message.data(), source.message.size(), "%s", message);
  png_longjmp(png, 1);
}

void IgnoreWarning(png_structp, png_const_charp) {}

// Whether libpng did `step` without an error. `step` makes no objects with destructors.
template <typename Step>
bool Try(png_structp png, const Step& step) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  step();
  return true;
}

// How a row comes from libpng.
struct PngLayout {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bits = 0;      // 8 or 16 a channel
  int channels = 0;  // colours, and alpha where there is one
  int passes = 0;    // 1, or 7 of an interlaced image
  std::size_t row_bytes = 0;

  int colours() const { return channels >= 3 ? 3 : 1; }
  bool has_alpha() const { return channels == 2 || channels == 4; }
};

class PngReader {
 public:
  PngReader(std::string_view bytes, const std::string& name) : name_(name), bytes_(bytes.size()) {
    source_.rest = bytes;
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, KeepError, IgnoreWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  RawImage Read(const ImageLimits& limits) {
    ReadHeader();
    CheckSize(name_, layout_.width, layout_.height, limits);
    CheckBytes();
    ChooseLayout();
    RawImage image;
    image.format = "PNG";
    image.bits = layout_.bits;
    image.full_scale = (1 << layout_.bits) - 1;
    image.full_scale_from = fmt::format("{} bits of the format", layout_.bits);
    image.had_alpha = layout_.has_alpha();
    image.planes.assign(
        static_cast<std::size_t>(layout_.colours()),
        SamplePlane(static_cast<int>(layout_.width), static_cast<int>(layout_.height)));
    ReadRows(image);
    return image;
  }

 private:
  template <typename Step>
  void Do(const Step& step) {
    if (Try(png_, step)) return;
    if (source_.ended) FailTruncated(name_);
    FailDamaged(name_, source_.message.data());
  }

  void ReadHeader() {
    Do([this] {
      png_set_read_fn(png_, &source_, ReadBytes);
      // Chunks beside the pixels are passed over, so that none of them is inflated; what is wrong
      // with their checksums is an error all the same.
      png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
      png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
      png_set_benign_errors(png_, 0);
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // CheckSize says it in words
      png_read_info(png_, info_);
      layout_.width = png_get_image_width(png_, info_);
      layout_.height = png_get_image_height(png_, info_);
    });
  }

  // Deflate makes at most 1032 bytes of one (zlib's "Technical Details", zlib.net/zlib_tech.html),
  // so that a short file with the header of a large image is told apart before memory is taken.
  void CheckBytes() const {
    constexpr std::uint64_t kMostFromAByte = 1032;
    const std::uint64_t pixel_bits =
        std::uint64_t{png_get_bit_depth(png_, info_)} * png_get_channels(png_, info_);
    const std::uint64_t pixels = std::uint64_t{layout_.width} * layout_.height;
    if (pixels * pixel_bits / 8 > kMostFromAByte * bytes_) FailTruncated(name_);
  }

  void ChooseLayout() {
    Do([this] {
      png_set_expand(png_);  // palettes to colours, fewer bits to 8, transparent colours to alpha
      layout_.passes = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      layout_.bits = png_get_bit_depth(png_, info_);
      layout_.channels = png_get_channels(png_, info_);
      layout_.row_bytes = png_get_rowbytes(png_, info_);
    });
  }

  void ReadRows(RawImage& image) {
    // Only an interlaced image has to be held as a whole: later passes fill what earlier ones left.
    const bool whole = layout_.passes > 1;
    std::vector<png_byte> rows(layout_.row_bytes * (whole ? layout_.height : 1));
    Do([&] {
      for (int pass = 0; pass < layout_.passes; ++pass) {
        for (png_uint_32 y = 0; y < layout_.height; ++y) {
          png_byte* row = rows.data() + (whole ? y * layout_.row_bytes : 0);
          png_read_row(png_, row, nullptr);
          if (pass + 1 == layout_.passes) Unpack(row, static_cast<int>(y), image);
        }
      }
      png_read_end(png_, nullptr);
    });
  }

  // Samples of a row, most significant byte first.
  void Unpack(const png_byte* row, int y, RawImage& image) const {
    const int bytes = layout_.bits / 8;
    const auto next = [&row, bytes] {
      const int sample = bytes == 1 ? row[0] : row[0] << 8 | row[1];
      row += bytes;
      return sample;
    };
    for (int x = 0; x < image.width(); ++x) {
      for (SamplePlane& plane : image.planes) plane.At(x, y) = static_cast<std::uint16_t>(next());
      if (layout_.has_alpha() && next() != image.full_scale) ++image.not_opaque;
    }
  }

  const std::string& name_;
  std::size_t bytes_;
  PngSource source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  PngLayout layout_;
};

}  // namespace

RawImage DecodePng(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return PngReader(bytes, name).Read(limits);
}

}  // namespace rockyard::image_files
