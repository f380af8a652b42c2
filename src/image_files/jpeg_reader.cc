// DecodeJpeg (read_image.h), by libjpeg: what would be a guess is an error, and what is too large
// is refused before memory is taken.
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <vector>
// After <cstdio> and <cstddef>, which they need.
#include <jpeglib.h>
// After <jpeglib.h>.
#include <jerror.h>

#include "image_files/raw_image.h"
#include "image_files/read_image.h"

namespace rockyard::image_files {
namespace {

// What the callbacks of libjpeg reach: `base` is the first member, so that its address is that of
// the whole. No object with a destructor lives between a setjmp and its longjmp.
struct JpegErrors {
  jpeg_error_mgr base{};
  std::jmp_buf back{};
  bool ended = false;
  bool unsupported = false;
  bool too_many_scans = false;
  std::array<char, JMSG_LENGTH_MAX> message{};
};

JpegErrors& ErrorsOf(j_common_ptr jpeg) { return *reinterpret_cast<JpegErrors*>(jpeg->err); }

[[noreturn]] void GiveUp(j_common_ptr jpeg) {
  JpegErrors& errors = ErrorsOf(jpeg);
  const int code = errors.base.msg_code;
  errors.ended = code == JWRN_JPEG_EOF || code == JERR_INPUT_EOF || code == JERR_INPUT_EMPTY;
  errors.unsupported = code == JERR_BAD_PRECISION || code == JERR_SOF_UNSUPPORTED;
  errors.base.format_message(jpeg, errors.message.data());
  std::longjmp(errors.back, 1);
}

// Warnings (level -1) mean that pixels are guessed from here on. Two of them do not: the version of
// the JFIF marker, and a transformation of colours that Adobe's marker does not know.
void JudgeMessage(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level < 0 && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM) GiveUp(jpeg);
}

void PrintNothing(j_common_ptr) {}

void CountScans(j_common_ptr jpeg) {
  const auto& decompress = *reinterpret_cast<j_decompress_ptr>(jpeg);
  if (decompress.input_scan_number <= kMaxJpegScans) return;
  ErrorsOf(jpeg).too_many_scans = true;
  std::longjmp(ErrorsOf(jpeg).back, 1);
}

class JpegReader {
 public:
  JpegReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = GiveUp;
    errors_.base.emit_message = JudgeMessage;
    errors_.base.output_message = PrintNothing;
    progress_.progress_monitor = CountScans;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  RawImage Read(const ImageLimits& limits) {
    Do([this] {
      jpeg_create_decompress(&jpeg_);
      jpeg_.progress = &progress_;
      jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()),
                   static_cast<unsigned long>(bytes_.size()));
      jpeg_read_header(&jpeg_, TRUE);
    });
    CheckSize(name_, jpeg_.image_width, jpeg_.image_height, limits);
    CheckBytes();
    ChooseColours();
    RawImage image;
    image.format = "JPEG";
    image.full_scale_from = "8 bits of the format";
    image.planes.assign(
        jpeg_.out_color_space == JCS_RGB ? 3 : 1,
        SamplePlane(static_cast<int>(jpeg_.image_width), static_cast<int>(jpeg_.image_height)));
    ReadRows(image);
    return image;
  }

 private:
  template <typename Step>
  void Do(const Step& step) {
    if (Try(step)) return;
    if (errors_.too_many_scans) {
      FailUnsupported(name_, "is in more than " + std::to_string(kMaxJpegScans) + " scans",
                      "check where it comes from, or save it again");
    }
    if (errors_.unsupported) {
      FailUnsupported(name_, std::string("is JPEG of another kind: ") + errors_.message.data(),
                      "save it as common JPEG with 8 bits a colour, or as PNG");
    }
    if (errors_.ended) FailTruncated(name_);
    FailDamaged(name_, errors_.message.data());
  }

  // Whether libjpeg did `step` without an error. `step` makes no objects with destructors.
  template <typename Step>
  bool Try(const Step& step) {
    if (setjmp(errors_.back) != 0) return false;
    step();
    return true;
  }

  // A block of 8 x 8 takes one bit at least (ITU-T T.81, annex F: the code of a difference), and
  // the smallest unit of a scan holds at most 4 x 4 blocks of the finest component: a short file
  // with the header of a large image is told apart before memory is taken.
  void CheckBytes() const {
    constexpr std::uint64_t kMostPixelsOfAByte = 8 * 4 * 4 * 64;
    const std::uint64_t pixels = std::uint64_t{jpeg_.image_width} * jpeg_.image_height;
    if (pixels > kMostPixelsOfAByte * bytes_.size()) FailTruncated(name_);
  }

  void ChooseColours() {
    if (jpeg_.arith_code != 0) {
      FailUnsupported(name_, "is a JPEG file with arithmetic coding",
                      "save it with Huffman coding, as most programs do, or as PNG");
    }
    switch (jpeg_.jpeg_color_space) {
      case JCS_GRAYSCALE:
        jpeg_.out_color_space = JCS_GRAYSCALE;
        break;
      case JCS_YCbCr:
      case JCS_RGB:
        jpeg_.out_color_space = JCS_RGB;
        break;
      case JCS_CMYK:
      case JCS_YCCK:
        FailUnsupported(name_, "is in the colours of print (CMYK)",
                        "save it in RGB or grey: how inks become light is not stated in the file");
      default:
        FailUnsupported(name_, "is in colours that it does not name", "save it in RGB or grey");
    }
  }

  void ReadRows(RawImage& image) {
    std::vector<JSAMPLE> row(std::size_t{jpeg_.image_width} * image.planes.size());
    Do([&] {
      jpeg_start_decompress(&jpeg_);
      while (jpeg_.output_scanline < jpeg_.output_height) {
        const int y = static_cast<int>(jpeg_.output_scanline);
        JSAMPROW rows[] = {row.data()};
        jpeg_read_scanlines(&jpeg_, rows, 1);
        const JSAMPLE* next = row.data();
        for (int x = 0; x < image.width(); ++x) {
          for (SamplePlane& plane : image.planes) plane.At(x, y) = *next++;
        }
      }
      jpeg_finish_decompress(&jpeg_);
    });
  }

  std::string_view bytes_;
  const std::string& name_;
  JpegErrors errors_;
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

RawImage DecodeJpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  return JpegReader(bytes, name).Read(limits);
}

}  // namespace rockyard::image_files
