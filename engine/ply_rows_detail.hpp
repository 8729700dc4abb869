// The rows of a PLY file, value by value: text and binary look alike to who reads them.
#pragma once

#include <marrow/error.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "bytes_detail.hpp"
#include "ply_detail.hpp"
#include "text_detail.hpp"

namespace marrow::ply_detail {

/// The rows of a text body: one to a line.
class TextRows {
 public:
  static constexpr bool kBinary = false;

  TextRows(const std::string& name, const Header& header)
      : name_(name), lines_(header.body), lines_before_(header.line_count) {}

  std::uint64_t bytes_left() const { return lines_.rest().size() + 1; }
  std::string place() const { return std::to_string(number()); }
  std::uint64_t number() const { return lines_before_ + lines_.number(); }

  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, place(), what);
  }

  void begin_row(const Element& element, std::uint64_t row) {
    do {
      if (!lines_.next())
        fail("the file ends before " + element.name + " " + std::to_string(row) + " of " +
             std::to_string(element.count) + "; it was cut short");
      line_ = lines_.line();
      text_detail::skip_blanks(line_);
    } while (line_.empty());
  }
  void end_row() {
    text_detail::skip_blanks(line_);
    if (!line_.empty())
      fail("the line goes on with " + text_detail::quoted(text_detail::take_word(line_)) +
           " behind its last value");
  }
  void end_body(std::size_t) {
    while (lines_.next()) {
      line_ = lines_.line();
      text_detail::skip_blanks(line_);
      if (!line_.empty())
        fail("the file goes on after its last row; a count in the header is too small");
    }
  }

  double number(Type) {
    double value = 0;
    if (!text_detail::take_number(line_, value)) wrong_word("a number");
    return value;
  }
  std::int64_t integer(Type) {
    std::int64_t value = 0;
    if (!text_detail::take_integer(line_, value)) wrong_word("a whole number");
    return value;
  }
  void skip(Type type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) number(type);
  }
  /// The room for values of a list.
  std::uint64_t most_values(Type) const { return line_.size(); }

 private:
  [[noreturn]] void wrong_word(const std::string& wanted) {
    const std::string_view word = text_detail::take_word(line_);
    fail(word.empty() ? "the line ends where " + wanted + " should stand"
                      : text_detail::quoted(word) + " where " + wanted + " should stand");
  }

  std::string name_;
  text_detail::Lines lines_;
  std::string_view line_;  // what is left of it
  std::uint64_t lines_before_;
};

/// The rows of a binary body: one after the other without gaps.
template <std::endian order>
class BinaryRows {
 public:
  static constexpr bool kBinary = true;
  static constexpr std::endian kOrder = order;

  BinaryRows(const std::string& name, const Header& header)
      : name_(name), at_(header.body.data()), end_(at_ + header.body.size()) {}

  std::uint64_t bytes_left() const { return static_cast<std::uint64_t>(end_ - at_); }
  std::string place() const {
    return element_ ? element_->name + " " + std::to_string(row_) : "header";
  }
  std::uint64_t number() const { return row_; }

  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, place(), what);
  }

  void begin_row(const Element& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  void end_row() {}
  void end_body(std::size_t last_row_bytes) {
    // Some programs end a binary file with a line feed.
    constexpr std::size_t kTolerated = 16;
    if (bytes_left() >= std::max(last_row_bytes, kTolerated))
      text_detail::fail(ErrorKind::Malformed, name_, "",
                        "goes on for " + std::to_string(bytes_left()) +
                            " bytes after its last row; a count in the header is too small");
  }

  double number(Type type) {
    switch (type) {
      case Type::Float32:
        return static_cast<double>(take<float>());
      case Type::Float64:
        return take<double>();
      default:
        return static_cast<double>(integer(type));
    }
  }
  std::int64_t integer(Type type) {
    switch (type) {
      case Type::Int8:
        return take<std::int8_t>();
      case Type::Uint8:
        return take<std::uint8_t>();
      case Type::Int16:
        return take<std::int16_t>();
      case Type::Uint16:
        return take<std::uint16_t>();
      case Type::Int32:
        return take<std::int32_t>();
      case Type::Uint32:
        return take<std::uint32_t>();
      default:
        fail("an index is not of an integer type");
    }
  }
  void skip(Type type, std::uint64_t count) {
    need(count * size_of(type));
    at_ += count * size_of(type);
  }
  std::uint64_t most_values(Type type) const { return bytes_left() / size_of(type); }

  /// For loops over rows of one size, which know how many there are.
  const char* at() const { return at_; }
  void advance(std::size_t bytes) { at_ += bytes; }

 private:
  void need(std::uint64_t bytes) const {
    if (bytes > bytes_left()) fail("the file ends here; it was cut short");
  }
  template <class Number>
  Number take() {
    need(sizeof(Number));
    const auto value = bytes_detail::load<Number, order>(at_);
    at_ += sizeof(Number);
    return value;
  }

  std::string name_;
  const char *at_, *end_;
  const Element* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace marrow::ply_detail
