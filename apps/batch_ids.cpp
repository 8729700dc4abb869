#include "batch_ids.hpp"

#include <algorithm>

#include "hash.hpp"

namespace marrow {

namespace {

// A name in a folder may have 255 bytes, a path 4095: this leaves room for what is put behind.
constexpr std::size_t kLongestComponent = 200, kLongestId = 1000;

/// Bytes of the character that `text` begins with, 0 if it is no UTF-8.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = byte(0) < 0x80                      ? 1
                           : byte(0) >= 0xc2 && byte(0) < 0xe0 ? 2
                           : byte(0) >= 0xe0 && byte(0) < 0xf0 ? 3
                           : byte(0) >= 0xf0 && byte(0) < 0xf5 ? 4
                                                               : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool is_overlong =
      (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool is_surrogate = byte(0) == 0xed && byte(1) >= 0xa0;
  const bool is_beyond = byte(0) == 0xf4 && byte(1) >= 0x90;
  return is_overlong || is_surrogate || is_beyond ? 0 : size;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool is_good = size > 0 && first >= 0x20 && first != 0x7f;
    if (is_good) result += text.substr(0, size);
    if (!is_good) result += '_';
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

/// `text` itself, or as much of it as leaves room for its hash, cut between characters.
std::string shortened(const std::string& text, std::size_t longest) {
  constexpr std::size_t kRoomForHash = 17;
  if (text.size() <= longest) return text;
  std::size_t end = longest - kRoomForHash;
  while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "~" + hex_of(hash_on(kFirstHash, text));
}

}  // namespace

std::string id_of(std::string_view name) {
  std::string id;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.size());
    const std::string_view component = name.substr(0, end);
    name.remove_prefix(std::min(end + 1, name.size()));
    if (component.empty() || component == "." || component == "..") continue;
    if (!id.empty()) id += '/';
    id += shortened(printable(component), kLongestComponent);
  }
  return id.empty() ? "_" : shortened(id, kLongestId);
}

UniqueIds::UniqueIds() : slots_(1024, 0) {}

std::string UniqueIds::add(std::string id) {
  const std::uint64_t hash = hash_on(kFirstHash, id);
  // Two ids of one hash are told apart like equal ones: that costs a suffix, and no id is kept.
  if (insert(hash)) return id;
  std::uint64_t& number = last_number_.try_emplace(hash, 1).first->second;
  for (;;) {
    std::string numbered = id + "~" + std::to_string(++number);
    if (insert(hash_on(kFirstHash, numbered))) return numbered;
  }
}

bool UniqueIds::insert(std::uint64_t hash) {
  hash = std::max<std::uint64_t>(hash, 1);
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = (hash ^ hash >> 32) & mask;
  for (; slots_[at] != 0; at = (at + 1) & mask)
    if (slots_[at] == hash) return false;
  slots_[at] = hash;
  if (++used_ * 2 > slots_.size()) grow();
  return true;
}

void UniqueIds::grow() {
  std::vector<std::uint64_t> before(slots_.size() * 2, 0);
  before.swap(slots_);
  used_ = 0;
  for (const std::uint64_t hash : before)
    if (hash != 0) insert(hash);
}

}  // namespace marrow
