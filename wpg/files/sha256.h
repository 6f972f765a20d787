#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's EVP_MD_CTX

namespace halfstep {

/// SHA-256 of bytes that come in parts; the only place that computes one. Throws std::runtime_error
/// when OpenSSL has none.
class Sha256Hash {
 public:
  Sha256Hash();
  void Add(std::string_view bytes);  ///< more of what is hashed
  /// The 32 bytes of the digest; nothing may be added after it.
  std::string Finish();
  std::string FinishHex();  ///< the same in lower-case hexadecimal

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// Lower-case hexadecimal SHA-256.
std::string Sha256(std::string_view bytes);

}  // namespace halfstep
