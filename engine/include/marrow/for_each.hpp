// How a stage runs what may go at the same time.
#pragma once

#include <cstddef>
#include <functional>

namespace marrow {

/// Runs task(i) for every i < count, in any order and on any threads; returns when all are done.
using ForEach =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// One after the other.
inline void for_each_in_turn(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

}  // namespace marrow
