// A shared library to be preloaded (LD_PRELOAD). It counts the calls by which a program changes
// files: open for writing, write, fsync, mkdir, rename, unlink and their kin; and makes one of them
// fail, or kills the program there.
//
//   HALFSTEP_FAULT_LOG=FILE   appends "number TAB operation TAB path [TAB path]" a call
//   HALFSTEP_FAULT_AT=N       the N-th call of a process, from 1 …
//   HALFSTEP_FAULT=kill       … is not made (of a write: half of it is), the process killed
//   HALFSTEP_FAULT=term       … is made after the program has been sent SIGTERM
//   HALFSTEP_FAULT=EIO|ENOSPC … is not made and fails so
//
// Standard output and error, pipes and devices do not count.

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
  long at = 0;
  int error = 0;  // 0: a signal
  bool term = false;
  int log = -1;
};

const Plan& ThePlan() {
  static const Plan plan = [] {
    Plan made;
    const char *at = getenv("HALFSTEP_FAULT_AT"), *what = getenv("HALFSTEP_FAULT"),
               *log = getenv("HALFSTEP_FAULT_LOG");
    if (at != nullptr) made.at = atol(at);
    if (what != nullptr && strcmp(what, "EIO") == 0) made.error = EIO;
    if (what != nullptr && strcmp(what, "ENOSPC") == 0) made.error = ENOSPC;
    made.term = what != nullptr && strcmp(what, "term") == 0;
    if (log != nullptr) {
      made.log = static_cast<int>(
          syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
    }
    return made;
  }();
  return plan;
}

std::atomic<long> calls{0};

struct Path {
  char text[2 * PATH_MAX] = "";
};

Path OfDescriptor(int fd) {
  Path path;
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path.text, sizeof path.text - 1);
  path.text[n > 0 ? n : 0] = '\0';
  return path;
}

Path Absolute(int folder, const char* name) {
  Path path;
  if (name[0] != '/') {
    path = folder == AT_FDCWD ? Path() : OfDescriptor(folder);
    if (folder == AT_FDCWD && getcwd(path.text, PATH_MAX) == nullptr) path.text[0] = '\0';
    strncat(path.text, "/", 2);
  }
  strncat(path.text, name, sizeof path.text - strlen(path.text) - 1);
  return path;
}

bool IsFileOrFolder(int fd) {
  struct stat status {};
  return fd > STDERR_FILENO && fd != ThePlan().log && fstat(fd, &status) == 0 &&
         (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
}

enum class Fate { kGoOn, kFail, kKill };

// Counts and logs a call, and says what becomes of it.
Fate Count(const char* operation, const Path& path, const Path* other = nullptr) {
  const Plan& plan = ThePlan();
  const long number = ++calls;
  if (plan.log >= 0) {
    static thread_local char line[6 * PATH_MAX];
    const int n = snprintf(line, sizeof line, "%ld\t%s\t%s%s%s\n", number, operation, path.text,
                           other != nullptr ? "\t" : "", other != nullptr ? other->text : "");
    syscall(SYS_write, plan.log, line, static_cast<size_t>(n));
  }
  if (number != plan.at) return Fate::kGoOn;
  if (plan.term) {
    kill(getpid(), SIGTERM);
    return Fate::kGoOn;
  }
  return plan.error != 0 ? Fate::kFail : Fate::kKill;
}

[[noreturn]] void Kill() {
  kill(getpid(), SIGKILL);
  while (true) pause();
}

// Whether the call shall be made; false: errno is set.
bool Passes(Fate fate) {
  if (fate == Fate::kKill) Kill();
  if (fate == Fate::kFail) errno = ThePlan().error;
  return fate == Fate::kGoOn;
}

template <typename Function>
Function* Next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool Changes(int flags) { return (flags & (O_CREAT | O_TRUNC | O_WRONLY | O_RDWR)) != 0; }

}  // namespace

extern "C" {

int openat(int folder, const char* name, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (Changes(flags) && strncmp(name, "/dev/", 5) != 0 &&
      !Passes(Count("open", Absolute(folder, name)))) {
    return -1;
  }
  return static_cast<int>(syscall(SYS_openat, folder, name, flags, mode));
}
int open(const char* name, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return openat(AT_FDCWD, name, flags, mode);
}
int open64(const char* name, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return openat(AT_FDCWD, name, flags, mode);
}

ssize_t write(int fd, const void* bytes, size_t size) {
  if (IsFileOrFolder(fd)) {
    const Fate fate = Count("write", OfDescriptor(fd));
    if (fate == Fate::kKill) syscall(SYS_write, fd, bytes, size / 2);
    if (!Passes(fate)) return -1;
  }
  return syscall(SYS_write, fd, bytes, size);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  if (IsFileOrFolder(fd) && !Passes(Count("write", OfDescriptor(fd)))) return -1;
  return syscall(SYS_writev, fd, parts, count);
}
ssize_t sendfile(int to, int from, off_t* offset, size_t size) {
  if (IsFileOrFolder(to)) {
    const Fate fate = Count("write", OfDescriptor(to));
    if (fate == Fate::kKill) syscall(SYS_sendfile, to, from, offset, size / 2);
    if (!Passes(fate)) return -1;
  }
  return syscall(SYS_sendfile, to, from, offset, size);
}
ssize_t sendfile64(int to, int from, off_t* offset, size_t size) {
  return sendfile(to, from, offset, size);
}

int fsync(int fd) {
  if (!Passes(Count("fsync", OfDescriptor(fd)))) return -1;
  return static_cast<int>(syscall(SYS_fsync, fd));
}
int fdatasync(int fd) {
  if (!Passes(Count("fsync", OfDescriptor(fd)))) return -1;
  return static_cast<int>(syscall(SYS_fdatasync, fd));
}

int mkdir(const char* name, mode_t mode) {
  if (!Passes(Count("mkdir", Absolute(AT_FDCWD, name)))) return -1;
  return static_cast<int>(syscall(SYS_mkdir, name, mode));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  const Path target = Absolute(to_folder, to);
  if (!Passes(Count("rename", Absolute(from_folder, from), &target))) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}
int rename(const char* from, const char* to) { return renameat2(AT_FDCWD, from, AT_FDCWD, to, 0); }

int unlinkat(int folder, const char* name, int flags) {
  if (!Passes(Count("unlink", Absolute(folder, name)))) return -1;
  return static_cast<int>(syscall(SYS_unlinkat, folder, name, flags));
}
int unlink(const char* name) { return unlinkat(AT_FDCWD, name, 0); }
int rmdir(const char* name) { return unlinkat(AT_FDCWD, name, AT_REMOVEDIR); }
int remove(const char* name) {
  if (!Passes(Count("unlink", Absolute(AT_FDCWD, name)))) return -1;
  return Next<int(const char*)>("remove")(name);
}

}  // extern "C"
