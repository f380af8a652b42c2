// The words and numbers of a file that begins as text (PGM, PPM and PFM), and numbers as bytes, for
// the readers and writers of this folder.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rockyard::image_files {

class HeaderText {
 public:
  // Reads a text of the file `name`. What is read is taken from the front of `bytes`. `bytes` and
  // `name` must outlive this object, and `bytes` also the words that it gives back.
  HeaderText(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  // Returns the next run of characters without white space. Comments, from # to the end of the
  // line, count as white space. Throws core::UserError where there is none.
  std::string_view Word();

  // Returns the next word as a whole number from 0 to `most`. Throws core::UserError, which calls
  // the number `what`.
  std::int64_t Number(std::string_view what, std::int64_t most);

  // Reads the one character of white space that stands between a header and bytes. Throws
  // core::UserError where it is missing.
  void EndOfHeader();

  // What has not been read.
  std::string_view rest() const { return rest_; }
  // What has not been read, without white space and comments in front.
  std::string_view RestWithoutBlanks();

 private:
  std::string_view rest_;
  const std::string& name_;
};

// Appends the bytes of a value, least significant first, on any machine.
inline void AppendLittleEndian(float value, std::string& bytes) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(word >> shift & 0xffU));
  }
}

}  // namespace rockyard::image_files
