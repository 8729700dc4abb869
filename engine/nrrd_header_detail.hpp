// The header of an NRRD file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "volume_detail.hpp"

namespace marrow::volume_detail {

enum class NrrdEncoding { Raw, Gzip, Text };

struct NrrdHeader {
  Placement placement;
  Samples samples;
  NrrdEncoding encoding = NrrdEncoding::Raw;
  std::string data_file;  ///< a plain name; empty: the values follow the header
  std::uint64_t line_skip = 0, byte_skip = 0;
  bool is_at_end = false;  ///< byte skip -1: the values are the last bytes
  std::size_t end = 0;     ///< where the bytes behind the header begin
};

/// Throws Error: Malformed (with the line), Unsupported.
NrrdHeader parse_nrrd_header(const Source& source);

}  // namespace marrow::volume_detail
