// XML as far as files of graphs need it: elements, attributes, text. No document types, so that no
// entity can grow or lead out of the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

/// Goes through a text of XML, one start, end or text after the other. `<a/>` is a start and an
/// end. Comments, instructions and text of blanks alone are passed over; prefixes of names are
/// dropped.
class XmlReader {
 public:
  enum class Event { Start, Text, End, EndOfFile };

  XmlReader(std::string_view text, Source source);

  /// Throws Error: Malformed, Unsupported (a document type, more than 64 elements in each other,
  /// UTF-16).
  Event next();

  /// Of the element that starts or ends.
  std::string_view name() const { return name_; }
  /// Of the element that starts; null if it is not there.
  const std::string* attribute(std::string_view name) const;
  /// The same; throws Error: Malformed if it is not there.
  const std::string& required(std::string_view name) const;
  /// As it stands in the file; no number has an entity in it.
  std::string_view text() const { return text_; }
  /// Elements that are open; the one that ends does not count.
  std::size_t depth() const { return open_.size(); }
  /// From 1: where the last event begins.
  std::size_t line() const { return line_; }
  const Source& source() const { return source_; }

  /// Goes to the end of the element that has just started.
  void skip_element();
  /// The text of the element that has just started, which ends with it; elements within are passed
  /// over. Throws Error: Malformed if they part the text.
  std::string_view element_text();
  /// The same, split into numbers: double or std::uint64_t.
  template <class Number>
  std::vector<Number> element_numbers();

  /// Calls `read` at the start of every element within the one that has just started, and goes to
  /// its end; `read` goes to the end of its own.
  template <class Read>
  void for_each_child(Read read) {
    for (Event event = next(); event != Event::End; event = next())
      if (event == Event::Start) read();
  }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Attribute {
    std::string_view name;
    std::string value;
  };

  char peek() const { return rest_.empty() ? '\0' : rest_.front(); }
  std::string_view take(std::size_t count);
  std::string_view take_until(std::string_view end, const char* what);
  void skip_blanks();
  std::string_view take_name();
  void read_attribute();
  Event read_start();
  Event read_end();
  bool pass_over();
  std::string decoded(std::string_view value) const;

  std::string_view rest_;
  Source source_;
  std::vector<std::string_view> open_;
  std::vector<Attribute> attributes_;
  std::string_view name_, text_;
  std::size_t line_ = 1, next_line_ = 1, text_line_ = 1;
  bool ends_at_once_ = false, has_root_ = false;
};

}  // namespace marrow::skeleton_detail
