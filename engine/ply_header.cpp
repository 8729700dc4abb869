#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <optional>

#include "ply_detail.hpp"
#include "text_detail.hpp"

namespace marrow::ply_detail {

namespace {

using text_detail::quoted;
using text_detail::take_word;

struct TypeName {
  std::string_view name;
  Type type;
};

constexpr std::array<TypeName, 16> kTypes{{{"char", Type::Int8},
                                           {"int8", Type::Int8},
                                           {"uchar", Type::Uint8},
                                           {"uint8", Type::Uint8},
                                           {"short", Type::Int16},
                                           {"int16", Type::Int16},
                                           {"ushort", Type::Uint16},
                                           {"uint16", Type::Uint16},
                                           {"int", Type::Int32},
                                           {"int32", Type::Int32},
                                           {"uint", Type::Uint32},
                                           {"uint32", Type::Uint32},
                                           {"float", Type::Float32},
                                           {"float32", Type::Float32},
                                           {"double", Type::Float64},
                                           {"float64", Type::Float64}}};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name)
      : name_(name), lines_(text_detail::without_mark(bytes)) {}

  Header read() {
    if (!lines_.next() || lines_.line() != "ply")
      fail("does not begin with 'ply'; check that it is a PLY file");
    bool has_format = false;
    while (lines_.next()) {
      std::string_view line = lines_.line();
      const std::string_view word = take_word(line);
      if (word.empty() || word == "comment" || word == "obj_info") continue;
      if (word == "end_header") {
        if (!has_format) fail("the header has no 'format' line");
        header_.line_count = lines_.number();
        header_.body = lines_.rest();
        return header_;
      }
      if (word == "format") {
        read_format(line);
        has_format = true;
      } else if (word == "element") {
        read_element(line);
      } else if (word == "property") {
        read_property(line);
      } else {
        fail(quoted(word) + " is no word of a PLY header");
      }
    }
    fail("the header has no 'end_header'; the file was cut short");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, std::to_string(lines_.number()), what);
  }

  void read_format(std::string_view line) {
    const std::string_view word = take_word(line);
    if (word == "ascii")
      header_.encoding = Encoding::Text;
    else if (word == "binary_little_endian")
      header_.encoding = Encoding::BinaryLittle;
    else if (word == "binary_big_endian")
      header_.encoding = Encoding::BinaryBig;
    else
      text_detail::fail(ErrorKind::Unsupported, name_, std::to_string(lines_.number()),
                        "the format " + quoted(word) + " is not read; write ascii or binary PLY");
  }

  void read_element(std::string_view line) {
    Element element;
    element.name = take_word(line);
    if (!text_detail::take_integer(line, element.count))
      fail("the count of element " + quoted(element.name) + " is no whole number from 0 on");
    for (const Element& other : header_.elements)
      if (other.name == element.name) fail("element " + quoted(element.name) + " comes twice");
    header_.elements.push_back(std::move(element));
  }

  void read_property(std::string_view line) {
    if (header_.elements.empty()) fail("a property before the first element");
    Property property;
    std::string_view word = take_word(line);
    property.is_list = word == "list";
    if (property.is_list) {
      property.count_type = type_of(take_word(line));
      if (property.count_type == Type::Float32 || property.count_type == Type::Float64)
        fail("the count of a list is not an integer type");
      word = take_word(line);
    }
    property.type = type_of(word);
    property.name = take_word(line);
    if (property.name.empty()) fail("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type type_of(std::string_view word) const {
    const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const TypeName& t) { return t.name == word; });
    if (found == kTypes.end()) fail(quoted(word) + " is no type of a PLY property");
    return found->type;
  }

  const std::string& name_;
  text_detail::Lines lines_;
  Header header_;
};

}  // namespace

std::size_t size_of(Type type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool Element::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const Property& p) { return p.is_list; });
}

std::size_t Element::row_bytes(Encoding encoding) const {
  constexpr std::size_t kShortestWord = 2;  // a digit and what parts it from the next one
  std::size_t sum = 0;
  for (const Property& p : properties)
    sum += encoding == Encoding::Text ? kShortestWord : size_of(p.is_list ? p.count_type : p.type);
  return sum;
}

Header parse_header(std::string_view bytes, const std::string& name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace marrow::ply_detail
