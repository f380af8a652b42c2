// The way back from web/gzip.h and web/base64.h, for tests.
#pragma once

#include <zlib.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rockyard::web::test {

// Throws std::runtime_error unless `bytes` are one whole gzip member.
inline std::string Gunzip(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::runtime_error("zlib cannot start");
  std::string in(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  std::string out;
  std::array<char, 1U << 16U> buffer{};
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::runtime_error("no whole gzip member");
  return out;
}

// What `html` carries between the payload element's tags, as JSON. Decodes RFC 4648 base64.
inline std::string PayloadOf(std::string_view html) {
  constexpr std::string_view kOpen = "id=\"payload\">";
  const std::size_t begin = html.find(kOpen) + kOpen.size();
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : html.substr(begin, html.find('<', begin) - begin)) {
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kAlphabet.find(c);
    if (digit == std::string_view::npos) break;
    bits = (bits << 6U) | static_cast<unsigned>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>((bits >> static_cast<unsigned>(held)) & 255U);
    }
  }
  return Gunzip(bytes);
}

}  // namespace rockyard::web::test
