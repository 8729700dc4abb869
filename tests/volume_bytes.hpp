// Volumes as bytes, and what is said about bad ones.
#pragma once

#include <marrow/error.hpp>
#include <marrow/volume_io.hpp>

#include <zlib.h>

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"

namespace marrow::test {

/// The bytes of `value` in this order.
template <class Number>
std::string bytes_of(Number value, std::endian order = std::endian::little) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (order != std::endian::native) bytes.assign(bytes.rbegin(), bytes.rend());
  return bytes;
}

template <class Number>
std::string bytes_of(const std::vector<double>& values, std::endian order) {
  std::string bytes;
  for (const double v : values) bytes += bytes_of(static_cast<Number>(v), order);
  return bytes;
}

inline std::string gzip(const std::string& bytes) {
  z_stream z{};
  REQUIRE(deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string result(deflateBound(&z, bytes.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(result.data());
  z.avail_out = static_cast<uInt>(result.size());
  REQUIRE(deflate(&z, Z_FINISH) == Z_STREAM_END);
  result.resize(z.total_out);
  deflateEnd(&z);
  return result;
}

struct VolumeRefusal {
  std::optional<ErrorKind> kind;
  std::string words;
};

inline VolumeRefusal refusal_of(std::string_view bytes, VolumeFormat format,
                                const VolumeOptions& options = {},
                                const std::string& path = "file") {
  try {
    parse_volume(bytes, format, path, options);
    return {};
  } catch (const Error& e) {
    return {e.kind(), e.what()};
  }
}

/// Refused with this kind in one line that begins with the name and says `part`.
inline void check_refused(std::string_view bytes, VolumeFormat format, ErrorKind kind,
                          std::string_view part, const VolumeOptions& options = {}) {
  const VolumeRefusal refusal = refusal_of(bytes, format, options);
  INFO("about " << part << ": " << refusal.words);
  CHECK(refusal.kind == kind);
  CHECK(refusal.words.starts_with("file:"));
  CHECK(refusal.words.find(part) != std::string::npos);
  CHECK(refusal.words.find('\n') == std::string::npos);
}

/// Foreground flags in the order of x, y, z as 0 and 1.
inline std::string flags_of(const Volume& v) {
  std::string flags;
  for (int z = 0; z < v.nz; ++z)
    for (int y = 0; y < v.ny; ++y)
      for (int x = 0; x < v.nx; ++x) flags += v(x, y, z) ? '1' : '0';
  return flags;
}

}  // namespace marrow::test
