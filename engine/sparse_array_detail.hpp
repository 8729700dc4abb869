// An array that takes memory only where it is used.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace marrow {

/// `size` elements, value-initialised `Block` at a time when one of them is first asked for. Asking
/// is safe from many threads at once.
template <class T, std::size_t Block>
class SparseArray {
 public:
  explicit SparseArray(std::size_t size) : blocks_((size + Block - 1) / Block) {}
  SparseArray(const SparseArray&) = delete;
  SparseArray& operator=(const SparseArray&) = delete;
  ~SparseArray() {
    for (auto& block : blocks_) delete[] block.load(std::memory_order_relaxed);
  }

  T& operator[](std::size_t i) { return *(block_of(i) + i % Block); }

 private:
  T* block_of(std::size_t i) {
    auto& block = blocks_[i / Block];
    T* seen = block.load(std::memory_order_acquire);
    return seen != nullptr ? seen : make(block);
  }

  static T* make(std::atomic<T*>& block) {
    auto fresh = std::make_unique<T[]>(Block);
    T* seen = nullptr;
    if (block.compare_exchange_strong(seen, fresh.get(), std::memory_order_acq_rel))
      return fresh.release();
    return seen;  // another thread was first
  }

  std::vector<std::atomic<T*>> blocks_;
};

}  // namespace marrow
