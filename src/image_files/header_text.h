// The words and numbers of a file that begins as text (PGM, PPM and PFM), and numbers as bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rockyard::image_files {

class HeaderText {
 public:
  // Of the file `name`. What is read is taken from the front of `bytes`. Both must outlive this,
  // and `bytes` the words that it gives back.
  HeaderText(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  // The next run of characters without white space. Comments, from # to the end of the line, count
  // as white space. Throws core::UserError where there is none.
  std::string_view Word();

  // The next word as a whole number from 0 to `most`. Throws core::UserError, which calls it
  // `what`.
  std::int64_t Number(std::string_view what, std::int64_t most);

  // The one character of white space that stands between a header and bytes. Throws
  // core::UserError.
  void EndOfHeader();

  // What has not been read.
  std::string_view rest() const { return rest_; }
  // The same without white space and comments in front.
  std::string_view RestWithoutBlanks();

 private:
  std::string_view rest_;
  const std::string& name_;
};

// Least significant byte first, on any machine.
inline void AppendLittleEndian(float value, std::string& bytes) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(word >> shift & 0xffU));
  }
}

}  // namespace rockyard::image_files
