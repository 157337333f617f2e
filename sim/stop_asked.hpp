// How a run is stopped from outside.
#pragma once

#include <functional>

namespace havers::sim {

/// Whether a run is to stop: asked between steps and breaks, and within those that take long. Once
/// true it stays so. Empty: never.
using StopAsked = std::function<bool()>;

/// False where `stop_asked` is empty.
inline bool stop_is_asked(const StopAsked& stop_asked) {
  return stop_asked && stop_asked();
}

}  // namespace havers::sim
