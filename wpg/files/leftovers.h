#pragma once

#include <sys/types.h>

#include <filesystem>

namespace halfstep {

// What this process has made and must not leave behind when a signal ends it: hidden partial files
// and folders, folders for a browser, the browser itself. Destructors do not run then. Signals are
// the process's, and so is this list. It has room for 32 entries; what does not fit stays, for the
// next command to remove.

/// Notes a file or a folder, with all that will be in it.
void AddLeftover(const std::filesystem::path& path);
/// Takes it off the list: it has been removed, or has got its final name.
void ForgetLeftover(const std::filesystem::path& path);

/// Notes a process group that is killed before anything is removed, and takes it off the list.
void AddLeftoverGroup(pid_t group);
/// See AddLeftoverGroup().
void ForgetLeftoverGroup(pid_t group);

/// Kills and removes all that is on the list and was put there by this process. Safe in a signal
/// handler. The thread that writes must not run meanwhile: call it there, or stop that first.
void RemoveLeftovers();

/// From now on SIGHUP, SIGINT, SIGPIPE, SIGTERM and SIGXCPU, unless they are ignored, remove what
/// is on the list before they end the process as they always do. For programs that have nothing
/// else to do with these signals; blocked ones are left alone.
void RemoveLeftoversAtSignals();

}  // namespace halfstep
