#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

namespace halfstep {

/// What a video of a report shows.
struct VideoOptions {
  std::optional<double> seconds;  ///< how long it lasts [s], > 0; none: as long as the walks
  std::string show;  ///< as the page's address after "#", e.g. "a=raw&b=none"; empty: as it opens
  int width = 1280, height = 720;  ///< [px], even
  int rate = 30;                   ///< frames a second
};

/// Frames between two calls of a VideoProgress, and two looks at a stop request.
inline constexpr int kFramesAtOnce = 10;

/// Called with the frames that are made, and all of them.
using VideoProgress = std::function<void(int, int)>;

/// A WebM of the page of a run, whose frames are drawn one after the other at their instants
/// whatever the clock says, by a Chromium that PATH has. Leaves nothing behind. std::nullopt when a
/// stop was requested. Throws std::runtime_error with a sentence when there is no browser or it
/// fails, InputError for a `show` that the page does not know. Source of the format: [RFC9559].
std::optional<std::string> WalkVideo(std::string_view page, const VideoOptions& options,
                                     const VideoProgress& progress, std::stop_token stop);

/// The bytes of a text in base64 without spaces. Precondition: it is one.
std::string FromBase64(std::string_view text);

}  // namespace halfstep
