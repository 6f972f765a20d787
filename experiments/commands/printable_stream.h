#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace halfstep {

/// While it lives, what is written to a stream reaches its end with control characters other than
/// line breaks shown as \xNN: no file's or argument's text commands a terminal.
class PrintableStream : private std::streambuf {
 public:
  explicit PrintableStream(std::ostream* stream);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int_type overflow(int_type byte) override;
  int sync() override;

  std::ostream* stream_;
  std::streambuf* end_;
  std::string waiting_;  // since the last flush
};

}  // namespace halfstep
