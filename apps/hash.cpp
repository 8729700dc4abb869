#include "hash.hpp"

#include <cstdio>

namespace marrow {

std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::string hex_of(std::uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

std::string hash_of(std::string_view bytes) {
  return "fnv1a64:" + hex_of(hash_on(kFirstHash, bytes));
}

}  // namespace marrow
