#include "wpg/files/leftovers.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string>

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 32;  // folders in folders
constexpr int kRounds = 16;   // looks into a folder that something else still writes into

enum State : int { kFree, kBusy, kSet };

struct Slot {
  std::atomic<int> state = kFree;
  pid_t owner = 0;  // a process between fork and exec has the list, but it is not its own
  pid_t group = 0;  // 0: a path
  std::array<char, PATH_MAX> path{};
};

std::array<Slot, 32>& Slots() {
  static std::array<Slot, 32> slots;
  return slots;
}

template <typename Fill>
void Add(const Fill& fill) {
  for (Slot& slot : Slots()) {
    int free = kFree;
    if (!slot.state.compare_exchange_strong(free, kBusy)) continue;
    slot.owner = getpid();
    fill(&slot);
    slot.state = kSet;
    return;
  }
}

template <typename Is>
void Forget(const Is& is) {
  for (Slot& slot : Slots()) {
    if (slot.state == kSet && is(slot)) slot.state = kFree;
  }
}

// Of linux/dirent.h, which glibc does not have; readdir may not be called in a signal handler.
struct DirectoryEntry {
  ino64_t inode;
  off64_t next;
  unsigned short length;
  unsigned char type;
  char name[1];
};

void RemoveTree(int folder, const char* name, int depth) {
  if (unlinkat(folder, name, 0) == 0 || depth > kDeepest) return;
  const int fd = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return;
  alignas(DirectoryEntry) std::array<char, 4096> buffer;
  for (int round = 0; round < kRounds; ++round) {
    lseek(fd, 0, SEEK_SET);
    for (long n = 0; (n = syscall(SYS_getdents64, fd, buffer.data(), buffer.size())) > 0;) {
      for (long at = 0; at < n;) {
        const auto* entry = reinterpret_cast<const DirectoryEntry*>(buffer.data() + at);
        at += entry->length;
        if (std::strcmp(entry->name, ".") == 0 || std::strcmp(entry->name, "..") == 0) continue;
        RemoveTree(fd, entry->name, depth + 1);
      }
    }
    if (unlinkat(folder, name, AT_REMOVEDIR) == 0) break;
  }
  close(fd);
}

void Wait(long milliseconds) {
  const timespec time{milliseconds / 1000, milliseconds % 1000 * 1'000'000};
  nanosleep(&time, nullptr);
}

// Ends a process group, and waits until it has gone: its last processes may still write.
void EndGroup(pid_t group) {
  kill(-group, SIGKILL);
  for (int i = 0; i < 100; ++i) {
    waitpid(group, nullptr, WNOHANG);
    if (kill(-group, 0) != 0) return;
    Wait(10);
  }
}

void EndBySignal(int signal) {
  RemoveLeftovers();
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);  // blocked until this returns
}

}  // namespace

void AddLeftover(const fs::path& path) {
  const std::string text = fs::absolute(path).string();
  if (text.size() >= PATH_MAX) return;
  Add([&](Slot* slot) {
    slot->group = 0;
    std::memcpy(slot->path.data(), text.c_str(), text.size() + 1);
  });
}

void ForgetLeftover(const fs::path& path) {
  const std::string text = fs::absolute(path).string();
  Forget([&](const Slot& slot) { return slot.group == 0 && text == slot.path.data(); });
}

void AddLeftoverGroup(pid_t group) {
  Add([group](Slot* slot) { slot->group = group; });
}

void ForgetLeftoverGroup(pid_t group) {
  Forget([group](const Slot& slot) { return slot.group == group; });
}

void RemoveLeftovers() {
  const pid_t self = getpid();
  for (const bool paths : {false, true}) {
    for (Slot& slot : Slots()) {
      if (slot.state != kSet || slot.owner != self || (slot.group == 0) != paths) continue;
      if (paths) {
        RemoveTree(AT_FDCWD, slot.path.data(), 0);
      } else {
        EndGroup(slot.group);
      }
    }
  }
}

void RemoveLeftoversAtSignals() {
  Slots();  // made before a handler needs it
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGTERM, SIGXCPU}) {
    struct sigaction action = {}, before = {};
    action.sa_handler = EndBySignal;
    sigfillset(&action.sa_mask);
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace halfstep
