#include "core/digest.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace rockyard::core {

std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("OpenSSL has no SHA-256");
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte / 16u];
    text += kDigits[byte % 16u];
  }
  return text;
}

}  // namespace rockyard::core
