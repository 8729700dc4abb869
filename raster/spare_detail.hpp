// Objects that tasks take turns with.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace marrow {

/// As many objects as are ever in use at a time, for what they keep of memory.
template <class T>
class Spare {
 public:
  /// work(object), with one that no other thread has meanwhile.
  template <class Work>
  decltype(auto) use(Work work) {
    const Loan loan(*this);
    return work(*loan.object);
  }

 private:
  struct Loan {
    explicit Loan(Spare& from) : spare(from), object(from.take()) {}
    ~Loan() { spare.give_back(std::move(object)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    Spare& spare;
    std::unique_ptr<T> object;
  };

  std::unique_ptr<T> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<T>();
    std::unique_ptr<T> object = std::move(free_.back());
    free_.pop_back();
    return object;
  }
  void give_back(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(object));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace marrow
