#include "wpg/files/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace halfstep {
namespace {

void CheckDone(bool done) {
  if (!done) throw std::runtime_error("OpenSSL has no SHA-256");
}

}  // namespace

Sha256Hash::Sha256Hash() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  CheckDone(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256Hash::Add(std::string_view bytes) {
  CheckDone(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256Hash::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  CheckDone(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1 && size == 32);
  return {digest.begin(), digest.begin() + size};
}

std::string Sha256Hash::FinishHex() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (const char byte : Finish()) {
    const unsigned value = static_cast<unsigned char>(byte);
    hex += kDigits[value >> 4];
    hex += kDigits[value & 15];
  }
  return hex;
}

std::string Sha256(std::string_view bytes) {
  Sha256Hash hash;
  hash.Add(bytes);
  return hash.FinishHex();
}

}  // namespace halfstep
