// A short name for bytes: 64 bits of FNV-1a. No protection against intent.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace marrow {

inline constexpr std::uint64_t kFirstHash = 0xcbf29ce484222325;

/// The hash of what `hash` has seen, and `bytes` behind it.
std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes);

/// "0123456789abcdef".
std::string hex_of(std::uint64_t hash);

/// "fnv1a64:0123456789abcdef".
std::string hash_of(std::string_view bytes);

}  // namespace marrow
