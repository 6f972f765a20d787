#include "wpg/files/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "wpg/files/partial_sibling.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostCopied = 1 << 30;  // bytes, as of a CSV that is read

[[noreturn]] void Fail(const fs::path& path, int error) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(error));
}

void Sync(int fd, const fs::path& shown) {
  if (fsync(fd) != 0) Fail(shown, errno);
}

void Write(int fd, std::string_view content, const fs::path& shown) {
  while (!content.empty()) {
    const ssize_t n = write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) Fail(shown, errno);
    content.remove_prefix(static_cast<size_t>(n));
  }
}

void CheckReplaceable(const fs::path& path) {
  const fs::file_type type = fs::symlink_status(path).type();
  if (type == fs::file_type::not_found || type == fs::file_type::regular) return;
  throw std::runtime_error(path.string() + (type == fs::file_type::symlink
                                                ? ": is a link, which is not followed (name the "
                                                  "file that it leads to)"
                                                : ": is no regular file, so it is not replaced"));
}

}  // namespace

SyncedFile::SyncedFile(const fs::path& path, fs::path shown)
    : shown_(std::move(shown)), file_(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW) {
  if (file_.get() < 0) Fail(shown_, errno);
}

void SyncedFile::Add(std::string_view part) { Write(file_.get(), part, shown_); }

void SyncedFile::Sync() { halfstep::Sync(file_.get(), shown_); }

void WriteSynced(const fs::path& path, const std::vector<std::string_view>& parts,
                 const fs::path& shown) {
  SyncedFile file(path, shown);
  for (const std::string_view part : parts) file.Add(part);
  file.Sync();
}

void WriteWhole(const fs::path& path, const std::vector<std::string_view>& parts) {
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  fs::create_directories(folder, error);
  if (error) Fail(folder, error.value());
  CheckReplaceable(path);
  RemoveAbandonedSiblings(folder, path.filename().string());
  PartialSibling partial(path, PartialSibling::Kind::kFile);
  for (const std::string_view part : parts) Write(partial.descriptor(), part, path);
  Sync(partial.descriptor(), path);
  if (rename(partial.path().c_str(), path.c_str()) != 0) Fail(path, errno);
  partial.Release();
  SyncFolder(folder, path);
}

void CopySynced(const fs::path& from, const fs::path& to, const fs::path& shown) {
  std::error_code error;
  if (const auto size = fs::file_size(from, error); !error && size > kMostCopied) {
    throw std::runtime_error(shown.string() + ": too large: " + std::to_string(size) +
                             " bytes (valid: at most 1 GiB)");
  }
  if (!fs::copy_file(from, to, fs::copy_options::none, error)) Fail(shown, error.value());
  const Descriptor file(to, O_RDONLY | O_NOFOLLOW);
  if (file.get() < 0) Fail(shown, errno);
  Sync(file.get(), shown);
}

void SyncFolder(const fs::path& folder, const fs::path& shown) {
  const Descriptor opened(folder, O_RDONLY | O_DIRECTORY);
  if (opened.get() < 0 || fsync(opened.get()) == 0) return;
  // What some file systems say of any folder.
  if (errno == EINVAL || errno == EBADF || errno == EROFS || errno == ENOTSUP) return;
  Fail(shown, errno);
}

}  // namespace halfstep
