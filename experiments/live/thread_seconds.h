#pragma once

namespace halfstep {

/// What the calling thread has taken of a processor so far [s]: told, never decided by.
double ThreadSeconds();

}  // namespace halfstep
