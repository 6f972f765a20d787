#include "experiments/commands/printable_stream.h"

#include "wpg/files/text.h"

namespace halfstep {

PrintableStream::PrintableStream(std::ostream* stream)
    : stream_(stream), end_(stream->rdbuf(this)) {}

PrintableStream::~PrintableStream() {
  stream_->flush();
  stream_->rdbuf(end_);
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
  waiting_.append(text, static_cast<size_t>(size));
  return size;
}

PrintableStream::int_type PrintableStream::overflow(int_type byte) {
  if (!traits_type::eq_int_type(byte, traits_type::eof())) {
    waiting_ += traits_type::to_char_type(byte);
  }
  return traits_type::not_eof(byte);
}

int PrintableStream::sync() {
  const std::string shown = Printable(waiting_);
  waiting_.clear();
  const auto size = static_cast<std::streamsize>(shown.size());
  return end_->sputn(shown.data(), size) == size ? end_->pubsync() : -1;
}

}  // namespace halfstep
