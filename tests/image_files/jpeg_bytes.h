// JPEG files of known colours (libjpeg's encoder).
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>
// After <cstdio> and <cstddef>, which it needs.
#include <jpeglib.h>

namespace rockyard::image_files {

struct JpegText {
  int width = 0;
  int height = 0;
  // Of column, row and component.
  std::function<int(int, int, int)> sample;
  J_COLOR_SPACE colour = JCS_GRAYSCALE;
  int components = 1;
  bool progressive = false;
  bool arithmetic = false;
  int restart_rows = 0;
  bool two_scans = false;  // progressive, of grey: the means, then all detail at full precision
};

// Of quality 100.
inline std::string JpegBytes(const JpegText& text) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(text.width);
  jpeg.image_height = static_cast<JDIMENSION>(text.height);
  jpeg.input_components = text.components;
  jpeg.in_color_space = text.colour;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (text.progressive) jpeg_simple_progression(&jpeg);
  const std::array<jpeg_scan_info, 2> scans{
      {{1, {0, 0, 0, 0}, 0, 0, 0, 0}, {1, {0, 0, 0, 0}, 1, 63, 0, 0}}};
  if (text.two_scans) {
    jpeg.scan_info = scans.data();
    jpeg.num_scans = static_cast<int>(scans.size());
  }
  jpeg.arith_code = text.arithmetic ? TRUE : FALSE;
  jpeg.restart_in_rows = text.restart_rows;
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<JSAMPLE> row(static_cast<std::size_t>(text.width * text.components));
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) {
      for (int c = 0; c < text.components; ++c) {
        row[static_cast<std::size_t>(x * text.components + c)] =
            static_cast<JSAMPLE>(text.sample(x, y, c));
      }
    }
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&jpeg, rows, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return file;
}

}  // namespace rockyard::image_files
