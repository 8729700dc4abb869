// What the shapes of a batch are called, in results and as files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace marrow {

/// The id that a path, or a name in a manifest, stands for: its components apart by '/', without
/// empty ones, "." and "..", so that it can be a path below any folder. Control characters and
/// bytes that are no UTF-8 become '_'; what is too long for a file is cut and ends in '~' and a
/// hash. "_" if nothing is left.
std::string id_of(std::string_view name);

/// Ids one after the other, each told from those before it: the second "a" becomes "a~2", the
/// third "a~3". What an id becomes depends on the list before it, not on the shard.
class UniqueIds {
 public:
  UniqueIds();
  std::string add(std::string id);

 private:
  bool insert(std::uint64_t hash);
  void grow();

  std::vector<std::uint64_t> slots_;  // hashes, for lists of millions; 0 is a free slot
  std::size_t used_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> last_number_;  // of those met again
};

}  // namespace marrow
