// The header of a PLY file: what its rows hold. http://paulbourke.net/dataformats/ply/
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace marrow::ply_detail {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

enum class Encoding { Text, BinaryLittle, BinaryBig };

/// The bytes of a value in a binary file.
std::size_t size_of(Type type);

struct Property {
  std::string name;
  Type type = Type::Float32;
  bool is_list = false;
  Type count_type = Type::Uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const;
  /// The bytes of a row whose lists are empty: a lower bound for all rows.
  std::size_t row_bytes(Encoding encoding) const;
};

struct Header {
  Encoding encoding = Encoding::Text;
  std::vector<Element> elements;
  std::uint64_t line_count = 0;
  std::string_view body;  ///< what follows the header
};

/// Throws Error: Malformed, Unsupported.
Header parse_header(std::string_view bytes, const std::string& name);

}  // namespace marrow::ply_detail
