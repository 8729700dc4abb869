// The medial axis pixel by pixel, as its rules say: what the fast one must equal.
#pragma once

#include <marrow/distance_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

namespace marrow::test {

class PlainMedialAxis {
 public:
  PlainMedialAxis(const DistanceMap& map, double prune_pixels)
      : width_(map.width() + 2), distance_(width_ * (map.height() + 2), 0), set_(distance_.size()) {
    for (int y = 0; y < map.height(); ++y)
      for (int x = 0; x < map.width(); ++x) distance_[(y + 1) * width_ + x + 1] = map(x, y);
    for (int i = 0; i < size(); ++i) set_[i] = distance_[i] != 0;
    std::vector<int> order = pixels();
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return distance_[a] < distance_[b]; });
    thin(order);
    to_unit_width(order);
    prune(prune_pixels);
    to_unit_width(pixels());
  }

  BitImage image() const {
    BitImage result(width_ - 2, size() / width_ - 2);
    for (const int i : pixels()) result.set(i % width_ - 1, i / width_ - 1);
    return result;
  }

 private:
  using Ring = std::array<int, 8>;

  int size() const { return static_cast<int>(set_.size()); }

  /// Counter-clockwise from the right.
  Ring ring(int i) const {
    const int w = width_;
    return {i + 1, i + 1 - w, i - w, i - 1 - w, i - 1, i - 1 + w, i + w, i + 1 + w};
  }

  std::vector<int> pixels() const {
    std::vector<int> result;
    for (int i = 0; i < size(); ++i)
      if (set_[i]) result.push_back(i);
    return result;
  }

  int neighbours(int i) const {
    int count = 0;
    for (const int n : ring(i)) count += set_[n];
    return count;
  }

  bool is_simple(int i) const {
    const Ring r = ring(i);
    int crossings = 0;
    for (std::size_t k = 0; k < 8; k += 2)
      crossings += !set_[r[k]] && (set_[r[k + 1]] || set_[r[(k + 2) % 8]]);
    return crossings == 1;
  }

  bool is_wide_end(int i) const {
    const Ring r = ring(i);
    bool side_by_side = false;
    for (std::size_t k = 0; k < 8; ++k) side_by_side |= set_[r[k]] && set_[r[(k + 1) % 8]];
    return neighbours(i) == 2 && side_by_side;
  }

  bool is_centre_of_maximal_disc(int i) const {
    const auto label = [&](int n) {
      return distance_[n] == 3 ? 1 : distance_[n] == 6 ? 5 : distance_[n];
    };
    const Ring r = ring(i);
    for (std::size_t k = 0; k < 8; ++k)
      if (label(r[k]) >= label(i) + (k % 2 == 0 ? 3 : 4)) return false;
    return true;
  }

  void thin(const std::vector<int>& order) {
    std::vector<bool> stays(set_.size());
    for (const int i : order) stays[i] = is_centre_of_maximal_disc(i);
    for (const int first : order) {
      std::vector<int> waiting{first};
      while (!waiting.empty()) {
        const int i = waiting.back();
        waiting.pop_back();
        if (!set_[i] || stays[i] || !is_simple(i)) continue;
        set_[i] = 0;
        for (const int n : ring(i))
          if (set_[n] && !stays[n] && distance_[n] <= distance_[i]) waiting.push_back(n);
      }
    }
  }

  void to_unit_width(const std::vector<int>& order) {
    for (const bool wide_ends_too : {false, true})
      for (const int i : order)
        if (set_[i] && is_simple(i) && neighbours(i) > 1 && (wide_ends_too || !is_wide_end(i)))
          set_[i] = 0;
  }

  /// The pixels from an end to the first that has more than two neighbours, or to the other end.
  std::vector<int> branch_from(int end) const {
    std::vector<int> branch{end};
    for (;;) {
      int next = -1;
      for (const int n : ring(branch.back()))
        if (set_[n] && (branch.size() < 2 || n != branch[branch.size() - 2])) next = n;
      if (next < 0) return branch;
      branch.push_back(next);
      if (neighbours(next) > 2) return branch;
    }
  }

  double reach(int end, int joint) const {
    const int dx = end % width_ - joint % width_, dy = end / width_ - joint / width_;
    return std::sqrt(static_cast<double>(dx * dx + dy * dy)) + pixels_of(distance_[end]) -
           pixels_of(distance_[joint]);
  }

  void prune(double most) {
    std::set<std::tuple<double, int, int>> queue;  // reach, end, joint
    const auto consider = [&](int end) {
      const int last = branch_from(end).back();
      if (neighbours(last) > 2 && reach(end, last) <= most)
        queue.insert({reach(end, last), end, last});
    };
    for (const int i : pixels())
      if (neighbours(i) == 1) consider(i);
    while (!queue.empty()) {
      const auto [tells, end, joint] = *queue.begin();
      queue.erase(queue.begin());
      if (!set_[end] || neighbours(end) != 1) continue;
      std::vector<int> branch = branch_from(end);
      if (neighbours(branch.back()) <= 2) continue;
      if (branch.back() != joint) {
        consider(end);
        continue;
      }
      branch.pop_back();
      for (const int i : branch) set_[i] = 0;
      if (neighbours(joint) == 1) consider(joint);
    }
  }

  int width_;
  std::vector<ChamferDistance> distance_;
  std::vector<std::uint8_t> set_;
};

}  // namespace marrow::test
