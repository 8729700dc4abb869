#include <marrow/homotopic_thinning.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "rank_queue_detail.hpp"
#include "simple_point_detail.hpp"

namespace marrow {

namespace {

using Word = VoxelSet::Word;

/// Where a voxel's bit lies in a VoxelSet: 64 times its word, plus the bit. In the order of the
/// voxels.
using BitPlace = std::uint32_t;

Word bit_of(BitPlace place) { return Word{1} << place % 64; }

/// The voxels of a set by rank: key first, then index.
class Ranking {
 public:
  Ranking(const VoxelSet& set, std::span<const std::uint16_t> key)
      : slot_(set.words().size(), 0), place_(key.size()) {
    std::vector<std::uint32_t> next(std::size_t{1} << 16, 0);
    for (const auto k : key) ++next[k];
    std::uint32_t sum = 0;
    for (auto& n : next) sum += std::exchange(n, sum);
    for (std::size_t w = 0, slots = 0; w < slot_.size(); ++w) {
      const Word word = set.words()[w];
      if (word == 0) continue;
      slot_[w] = static_cast<std::uint32_t>(slots) - low_bit(word);
      slots += static_cast<std::size_t>(std::bit_width(word)) - low_bit(word);
      rank_.resize(slots);
    }
    auto k = key.begin();
    for (std::size_t w = 0; w < slot_.size(); ++w)
      for (Word left = set.words()[w]; left != 0; left &= left - 1) {
        const std::uint32_t rank = next[*k++]++;
        rank_[slot_[w] + low_bit(left)] = rank;
        place_[rank] = static_cast<BitPlace>(64 * w) + low_bit(left);
      }
  }

  std::size_t size() const { return place_.size(); }
  BitPlace place(std::uint32_t rank) const { return place_[rank]; }
  std::uint32_t rank(BitPlace place) const { return rank_[slot_[place / 64] + place % 64]; }

 private:
  static std::uint32_t low_bit(Word word) {
    return static_cast<std::uint32_t>(std::countr_zero(word));
  }

  std::vector<std::uint32_t> slot_;  // of bit 0 of every word in rank_, modulo 2^32
  std::vector<std::uint32_t> rank_;
  std::vector<BitPlace> place_;
};

/// A bit for every voxel of a grid, and what lies around one that is not on the outermost layer.
class Plane {
 public:
  Plane(const VoxelSet& shape, std::vector<Word> words)
      : words_(std::move(words)),
        row_(shape.words_per_row()),
        layer_(row_ * shape.rows_per_layer()) {}

  std::span<const Word> words() const { return words_; }
  bool has(BitPlace place) const { return (words_[place / 64] & bit_of(place)) != 0; }
  void insert(BitPlace place) { words_[place / 64] |= bit_of(place); }
  void erase(BitPlace place) { words_[place / 64] &= ~bit_of(place); }

  /// The neighbours of a place, and the place itself.
  Neighbourhood around(BitPlace place) const {
    const Word *low = first_word(place), *middle = low + layer_, *high = middle + layer_;
    const unsigned shift = (place - 1) % 64;
    if (shift > 61) return around_two_words(low, shift);
    const auto three = [&](Neighbourhood bits, const Word* layer) {
      for (const Word* w : {layer, layer + row_, layer + 2 * row_})
        bits = bits << 3 | static_cast<Neighbourhood>(*w >> shift & 7);
      return bits;
    };
    return three(three(three(0, low), middle), high);
  }

  /// The neighbours of a place that share a face with it.
  Neighbourhood beside(BitPlace place) const {
    const Word* word = words_.data() + place / 64;
    const auto bit = [&](const Word* w) {
      return static_cast<Neighbourhood>(*w >> place % 64 & 1);
    };
    const auto along = [&](BitPlace p) {
      return static_cast<Neighbourhood>(words_[p / 64] >> p % 64 & 1);
    };
    return bit(word - layer_) << 22 | bit(word - row_) << 16 | along(place + 1) << 14 |
           along(place - 1) << 12 | bit(word + row_) << 10 | bit(word + layer_) << 4;
  }

  /// False: around() is empty.
  bool may_have_around(BitPlace place) const {
    const Word *low = first_word(place), *middle = low + layer_, *high = middle + layer_;
    const unsigned shift = (place - 1) % 64;
    const auto any = [&](const Word* w) { return w[0] | w[row_] | w[2 * row_]; };
    return ((any(low) | any(middle) | any(high)) >> shift & 7) != 0 || shift > 61;
  }

 private:
  const Word* first_word(BitPlace place) const {
    return words_.data() + (place - 1) / 64 - row_ - layer_;
  }

  Neighbourhood around_two_words(const Word* layer, unsigned shift) const {
    Neighbourhood bits = 0;
    for (int z = 0; z < 3; ++z, layer += layer_)
      for (const Word* w : {layer, layer + row_, layer + 2 * row_}) {
        const Word three = w[0] >> shift | w[1] << (64 - shift);
        bits = bits << 3 | static_cast<Neighbourhood>(three & 7);
      }
    return bits;
  }

  std::vector<Word> words_;
  std::size_t row_, layer_;  // in words
};

/// From the place of a voxel to its neighbours, counted as in a Neighbourhood.
std::array<BitPlace, 27> steps_of(const VoxelSet& shape) {
  const auto row = static_cast<int>(64 * shape.words_per_row());
  const int layer = row * static_cast<int>(shape.rows_per_layer());
  std::array<BitPlace, 27> steps{};
  for (int i = 0; i < 27; ++i)
    steps[static_cast<std::size_t>(i)] =
        static_cast<BitPlace>(i % 3 - 1 - (i / 3 % 3 - 1) * row - (i / 9 - 1) * layer);
  return steps;
}

/// The voxels of `set` without an open face.
std::vector<Word> interior(const VoxelSet& set) {
  const std::span<const Word> words = set.words();
  const std::size_t row = set.words_per_row(), layer = row * set.rows_per_layer();
  std::vector<Word> result(words.size(), 0);
  for (std::size_t w = layer; w + layer < words.size(); ++w) {
    const Word before = words[w] << 1 | words[w - 1] >> 63;
    const Word after = words[w] >> 1 | words[w + 1] << 63;
    result[w] = words[w] & before & after & words[w - row] & words[w + row] & words[w - layer] &
                words[w + layer];
  }
  return result;
}

std::vector<Word> words_of(const VoxelSet& set) { return {set.words().begin(), set.words().end()}; }

std::vector<Word> without(std::vector<Word> words, std::span<const Word> others) {
  for (std::size_t w = 0; w < words.size(); ++w) words[w] &= ~others[w];
  return words;
}

VoxelSet set_of(const VoxelGrid& grid, std::span<const std::uint32_t> voxels) {
  VoxelSet set(grid);
  for (const auto v : voxels) set.insert(v);
  return set;
}

class Thinning {
 public:
  Thinning(const VoxelSet& set, std::span<const std::uint16_t> key, const VoxelSet& anchors)
      : steps_(steps_of(set)),
        ranking_(set, key),
        behind_(ranking_.size()),
        in_(set, words_of(set)),
        idle_(set, without(interior(set), anchors.words())),
        waiting_(set, std::vector<Word>(set.words().size(), 0)),
        passed_(set, words_of(anchors)) {}

  /// Every voxel comes up once in the order of the ranks; what is queued behind that goes first.
  std::span<const Word> run() {
    for (std::uint32_t rank = 0; rank < ranking_.size(); ++rank) {
      const BitPlace place = ranking_.place(rank);
      if (passed_.has(place)) continue;
      passed_.insert(place);
      if (idle_.has(place)) continue;
      try_to_remove(place);
      while (!behind_.empty()) try_to_remove(ranking_.place(behind_.pop()));
    }
    return in_.words();
  }

 private:
  void try_to_remove(BitPlace place) {
    if (!is_simple_(in_.around(place))) {
      waiting_.insert(place);
      idle_.insert(place);
      return;
    }
    in_.erase(place);
    // What this lays open, and what waited for a change around it, comes up.
    Neighbourhood up = idle_.beside(place);
    if (waiting_.may_have_around(place)) up |= waiting_.around(place);
    for (; up != 0; up &= up - 1) {
      const BitPlace n = place + steps_[static_cast<std::size_t>(std::countr_zero(up))];
      idle_.erase(n);
      waiting_.erase(n);
      if (passed_.has(n)) behind_.push(ranking_.rank(n));
    }
  }

  std::array<BitPlace, 27> steps_;
  Ranking ranking_;
  RankQueue behind_;
  Plane in_;       // what is left of the set
  Plane idle_;     // of that, what is neither to come up nor an anchor
  Plane waiting_;  // of that, what was not simple when it came up
  Plane passed_;   // whose turn has passed, and the anchors
  SimplePoints is_simple_;
};

}  // namespace

VoxelSet thin(const VoxelGrid& grid, VoxelSet set, std::span<const std::uint16_t> key,
              std::span<const std::uint32_t> anchors) {
  Thinning thinning(set, key, set_of(grid, anchors));
  const std::span<const Word> left = thinning.run();
  std::copy(left.begin(), left.end(), set.row(0));
  return set;
}

}  // namespace marrow
