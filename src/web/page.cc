#include "web/page.h"

#define ZLIB_CONST  // its input is const
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/base64.h"
#include "core/text.h"

namespace rockyard::web {
namespace {

// Replaces the first mark; a page without it was not bundled by build.mjs.
void Fill(std::string& html, std::string_view mark, std::string_view value) {
  const std::size_t at = html.find(mark);
  if (at == std::string::npos) throw std::logic_error("a bundled page lacks a mark to fill in");
  html.replace(at, mark.size(), value);
}

std::string_view Bundled(Page page) {
  switch (page) {
    case Page::kReport:
      return kReportPage;
    case Page::kReplay:
      return kReplayPage;
    case Page::kBench:
      break;
  }
  return kBenchPage;
}

}  // namespace

std::string MakePage(Page page, std::string_view title, std::string_view payload_json) {
  std::string html(Bundled(page));
  Fill(html, "<!-- title -->", core::EscapeXml(title));
  Fill(html, "<!-- payload -->", core::Base64(Gzip(payload_json)));
  return html;
}

namespace {

constexpr std::size_t kBuffer = 1U << 16U;
constexpr int kGzipWindow = 15 + 16;  // the largest window; 16 asks for gzip rather than zlib
constexpr int kMemory = 9;

// A deflate stream that ends with the scope.
class Deflater {
 public:
  Deflater() {
    if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemory,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::runtime_error("zlib cannot start: no memory");
    }
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  // Compresses `bytes` and appends what comes out; with `last` everything.
  void Add(std::string_view bytes, bool last, std::string& out) {
    stream_.next_in = reinterpret_cast<const Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    std::string buffer(kBuffer, '\0');
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream_.avail_out = static_cast<uInt>(buffer.size());
      if (deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH) == Z_STREAM_ERROR) {
        throw std::runtime_error("zlib lost its state");
      }
      out.append(buffer, 0, buffer.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

 private:
  z_stream stream_{};
};

}  // namespace

std::string Gzip(std::string_view bytes) {
  constexpr std::size_t kMax = std::numeric_limits<uInt>::max();  // that zlib takes at once
  Deflater deflater;
  std::string out;
  do {
    const std::string_view part = bytes.substr(0, std::min(bytes.size(), kMax));
    bytes.remove_prefix(part.size());
    deflater.Add(part, bytes.empty(), out);
  } while (!bytes.empty());
  return out;
}

}  // namespace rockyard::web
