// Everything that reads what comes from outside, as functions of bytes.
#pragma once

#include <span>
#include <string_view>

namespace rockyard {

struct Reader {
  std::string_view name;  // of its folder of tests/data/readers
  // Reads the bytes. Throws core::UserError where they are refused; all else that it throws is
  // wrong.
  void (*read)(std::string_view bytes);
};

std::span<const Reader> Readers();

// Reads the bytes and swallows the refusal; whether they were accepted.
bool Accepts(const Reader& reader, std::string_view bytes);

}  // namespace rockyard
