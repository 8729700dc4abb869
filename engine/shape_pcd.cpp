// PCD of the Point Cloud Library, as text and binary:
// https://pointclouds.org/documentation/tutorials/pcd_file_format.html

#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "bytes_detail.hpp"
#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using text_detail::quoted;
using text_detail::take_word;

constexpr std::uint64_t kMostValues = 1 << 20;  // of a field

/// One value of a point, or several under one name.
struct Field {
  std::string name;
  char type = 'F';
  std::uint64_t size = 4, count = 1;
};

struct PcdHeader {
  std::vector<Field> fields;
  std::uint64_t points = 0;
  bool is_binary = false;
  std::uint64_t line_count = 0;
  std::string_view body;
};

class PcdHeaderReader {
 public:
  PcdHeaderReader(std::string_view bytes, const std::string& name)
      : name_(name), lines_(text_detail::without_mark(bytes)) {}

  PcdHeader read() && {
    while (lines_.next()) {
      line_ = text_detail::without_comment(lines_.line());
      const std::string_view word = take_word(line_);
      if (word == "DATA") {
        read_data();
        return std::move(header_);
      }
      read_entry(word);
    }
    fail("the header has no 'DATA' line; check that it is a PCD file, and whole");
  }

 private:
  [[noreturn]] void fail(const std::string& what, ErrorKind kind = ErrorKind::Malformed) const {
    text_detail::fail(kind, name_, std::to_string(lines_.number()), what);
  }

  void read_entry(std::string_view word) {
    if (word.empty() || word == "VERSION" || word == "VIEWPOINT") return;
    if (word == "FIELDS" || word == "COLUMNS") {
      if (!header_.fields.empty()) fail("the fields are named twice");
      for (std::string_view f = take_word(line_); !f.empty(); f = take_word(line_))
        header_.fields.push_back({std::string(f)});
    } else if (word == "SIZE") {
      for (Field& f : header_.fields) f.size = take_count("size");
    } else if (word == "COUNT") {
      for (Field& f : header_.fields) f.count = take_count("count");
    } else if (word == "TYPE") {
      for (Field& f : header_.fields) f.type = take_type();
    } else if (word == "WIDTH") {
      width_ = take_count("width");
    } else if (word == "HEIGHT") {
      height_ = take_count("height");
    } else if (word == "POINTS") {
      points_ = take_count("count of points");
    } else {
      fail(quoted(word) + " is no word of a PCD header");
    }
  }

  std::uint64_t take_count(const char* what) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 32;  // so that no product overflows
    std::uint64_t count = 0;
    if (!text_detail::take_integer(line_, count) || count > kMost)
      fail(std::string("a ") + what + " is missing or is not a whole number up to 4294967296");
    return count;
  }

  char take_type() {
    const std::string_view word = take_word(line_);
    if (word != "I" && word != "U" && word != "F")
      fail(quoted(word) + " is no type; use I, U or F");
    return word.front();
  }

  void read_data() {
    const std::string_view word = take_word(line_);
    if (word == "binary_compressed")
      fail("compressed PCD is not read; write it as binary or ascii", ErrorKind::Unsupported);
    if (word != "ascii" && word != "binary")
      fail(quoted(word) + " is no kind of data; use ascii or binary");
    header_.is_binary = word == "binary";
    if (width_ && points_ && *width_ * height_ != *points_)
      fail("the header counts " + std::to_string(*points_) + " points, but a width of " +
           std::to_string(*width_) + " times a height of " + std::to_string(height_));
    if (!width_ && !points_) fail("the header does not count its points");
    header_.points = points_ ? *points_ : *width_ * height_;
    header_.line_count = lines_.number();
    header_.body = lines_.rest();
  }

  std::string name_;
  text_detail::Lines lines_;
  std::string_view line_;  // what is left of it
  std::optional<std::uint64_t> width_, points_;
  std::uint64_t height_ = 1;
  PcdHeader header_;
};

/// Where a coordinate stands in a row.
struct Coordinate {
  char type = 'F';
  std::uint64_t size = 4, byte = 0, column = 0;
};

class PcdBodyReader {
 public:
  PcdBodyReader(const Source& source, const PcdHeader& header)
      : name_(source.name), header_(header), builder_(source, "point ") {
    for (std::size_t k = 0; k < 3; ++k) xyz_[k] = coordinate(std::string_view("xyz").substr(k, 1));
    for (const Field& f : header_.fields) row_bytes_ += f.size * f.count, columns_ += f.count;
  }

  Shape read() && {
    // A count is only believed if the rest of the file has room for it.
    const std::uint64_t least = header_.is_binary ? row_bytes_ : 2 * columns_;
    // Behind the last value of a text there need not be an end of line.
    const std::uint64_t room = header_.body.size() + (header_.is_binary ? 0 : 1);
    if (header_.points > room / least)
      text_detail::fail(ErrorKind::Malformed, name_, "header",
                        "counts " + std::to_string(header_.points) + " points, but only " +
                            std::to_string(header_.body.size()) +
                            " bytes follow; the file was cut short or its header is wrong");
    builder_.reserve(header_.points, 0);
    if (header_.is_binary)
      read_binary();
    else
      read_text();
    return std::move(builder_).finish();
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, place, what);
  }

  Coordinate coordinate(std::string_view name) const {
    Coordinate c;
    for (const Field& f : header_.fields) {
      const bool legal_size = f.size == 1 || f.size == 2 || f.size == 4 || f.size == 8;
      if (!legal_size || (f.type == 'F' && f.size < 4) || f.count > kMostValues)
        fail("header", "field " + quoted(f.name) + " has a size or a count that no field has");
      if (f.name == name && f.count == 1) return {f.type, f.size, c.byte, c.column};
      c.byte += f.size * f.count;
      c.column += f.count;
    }
    fail("header", "there is no field " + quoted(name) + "; a point needs x, y and z");
  }

  /// A place without a point is written as not a number.
  void add(const Vec3& p, std::uint64_t number) {
    if (!std::isnan(p.x) && !std::isnan(p.y) && !std::isnan(p.z)) builder_.add_point(p, number);
  }

  void read_binary() {
    const char* row = header_.body.data();
    for (std::uint64_t i = 0; i < header_.points; ++i, row += row_bytes_)
      add({value_at(row, xyz_[0]), value_at(row, xyz_[1]), value_at(row, xyz_[2])}, i);
  }

  static double value_at(const char* row, const Coordinate& c) {
    using bytes_detail::load;
    constexpr auto kLittle = std::endian::little;
    const char* at = row + c.byte;
    if (c.type == 'F')
      return c.size == 4 ? double{load<float, kLittle>(at)} : load<double, kLittle>(at);
    const bool is_signed = c.type == 'I';
    switch (c.size) {
      case 1:
        return is_signed ? load<std::int8_t, kLittle>(at) : load<std::uint8_t, kLittle>(at);
      case 2:
        return is_signed ? load<std::int16_t, kLittle>(at) : load<std::uint16_t, kLittle>(at);
      case 4:
        return is_signed ? load<std::int32_t, kLittle>(at) : load<std::uint32_t, kLittle>(at);
      default:
        return is_signed ? static_cast<double>(load<std::int64_t, kLittle>(at))
                         : static_cast<double>(load<std::uint64_t, kLittle>(at));
    }
  }

  void read_text() {
    text_detail::check_is_text(header_.body, name_);
    text_detail::Lines lines(header_.body);
    std::uint64_t count = 0;
    while (lines.next()) {
      std::string_view line = lines.line();
      text_detail::skip_blanks(line);
      if (line.empty()) continue;
      const std::string place = std::to_string(header_.line_count + lines.number());
      if (count == header_.points) fail(place, "the file goes on after its last point");
      add(read_row(line, place), count++);
    }
    if (count < header_.points)
      fail(std::to_string(header_.line_count + lines.number()),
           "the file ends after " + std::to_string(count) + " of " +
               std::to_string(header_.points) + " points; it was cut short");
  }

  Vec3 read_row(std::string_view line, const std::string& place) const {
    std::array<double, 3> p{};
    for (std::uint64_t column = 0; column < columns_; ++column) {
      const auto found = std::find_if(xyz_.begin(), xyz_.end(),
                                      [&](const Coordinate& c) { return c.column == column; });
      if (found == xyz_.end()) {
        take_word(line);
        continue;
      }
      if (!text_detail::take_number(line, p[static_cast<std::size_t>(found - xyz_.begin())])) {
        const std::string_view word = take_word(line);
        fail(place, word.empty() ? "a point has fewer values than there are fields"
                                 : quoted(word) + " is not a number");
      }
    }
    return {p[0], p[1], p[2]};
  }

  std::string name_;
  const PcdHeader& header_;
  ShapeBuilder builder_;
  std::array<Coordinate, 3> xyz_;
  std::uint64_t row_bytes_ = 0, columns_ = 0;
};

}  // namespace

Shape parse_pcd(const Source& source) {
  const PcdHeader header = PcdHeaderReader(source.bytes, source.name).read();
  return PcdBodyReader(source, header).read();
}

}  // namespace marrow::shape_detail
