// Lines, words and numbers of text files: strict, whole words, no locale.
#pragma once

#include <marrow/error.hpp>

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace marrow::text_detail {

/// Throws Error: "name:place: what". A place is a line number, or words such as "face 12".
[[noreturn]] void fail(ErrorKind kind, const std::string& name, const std::string& place,
                       const std::string& what);

/// `word` in quotes, cut short and without control characters, so that a message stays one line.
std::string quoted(std::string_view word);

/// `text` without the byte order mark of UTF-8.
std::string_view without_mark(std::string_view text);

/// `line` up to a word that begins with '#'. Within a word the sign is part of it: some programs
/// write 1.#INF.
std::string_view without_comment(std::string_view line);

/// True if there are bytes that no text of ours holds: control characters but for blanks and ends
/// of line.
bool has_control_characters(std::string_view text);

/// Throws Malformed if `text` is not text.
void check_is_text(std::string_view text, const std::string& name);

/// A text line by line. Lines end in LF, CR LF, or, if the first one does, in CR alone.
class Lines {
 public:
  explicit Lines(std::string_view text);

  /// Goes to the next line; false at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find(end_of_line_);
    const bool last = end == std::string_view::npos;
    raw_ = rest_.substr(0, last ? rest_.size() : end + 1);
    rest_.remove_prefix(raw_.size());
    line_ = last ? raw_ : raw_.substr(0, end);
    while (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    ++number_;
    return true;
  }

  std::string_view line() const { return line_; }   ///< without its end
  std::string_view raw() const { return raw_; }     ///< with its end
  std::string_view rest() const { return rest_; }   ///< what no line has used yet
  std::uint64_t number() const { return number_; }  ///< from 1

 private:
  std::string_view rest_, raw_, line_;
  char end_of_line_ = '\n';
  std::uint64_t number_ = 0;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

inline void skip_blanks(std::string_view& text) {
  std::size_t i = 0;
  while (i < text.size() && is_blank(text[i])) ++i;
  text.remove_prefix(i);
}

/// To the next of `lines` that is not empty without its comment and leading blanks: that is `line`.
/// False at the end.
inline bool next_filled(Lines& lines, std::string_view& line) {
  while (lines.next()) {
    line = without_comment(lines.line());
    skip_blanks(line);
    if (!line.empty()) return true;
  }
  return false;
}

/// Takes the first word off `text`; empty if there is none.
inline std::string_view take_word(std::string_view& text) {
  skip_blanks(text);
  std::size_t i = 0;
  while (i < text.size() && !is_blank(text[i])) ++i;
  const std::string_view word = text.substr(0, i);
  text.remove_prefix(i);
  return word;
}

/// `word` as a number in all forms that from_chars leaves out: a leading plus, and numbers that no
/// double holds, which become 0 or infinite.
bool parse_unusual_number(std::string_view word, double& value);

/// Takes a number of the form -12.345 off `text` if it has few digits: both the digits and the
/// power of ten are doubles then, and their quotient is the nearest one.
inline bool take_short_decimal(std::string_view& text, double& value) {
  constexpr double kPowers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr std::ptrdiff_t kMostDigits = 15;
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const first = at;
    for (; at != end && *at >= '0' && *at <= '9'; ++at)
      digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
    return at - first;
  };
  const std::ptrdiff_t whole = take_digits();
  std::ptrdiff_t fraction = 0;
  if (at != end && *at == '.') ++at, fraction = take_digits();
  if (whole + fraction == 0 || whole + fraction > kMostDigits) return false;
  if (at != end && !is_blank(*at)) return false;
  value = static_cast<double>(digits) / kPowers[fraction];
  if (negative) value = -value;
  text.remove_prefix(static_cast<std::size_t>(at - text.data()));
  return true;
}

/// Takes a number off `text` if its first word is one as a whole; it may be infinite or not a
/// number. Else false, and `text` begins with the word in question.
inline bool take_number(std::string_view& text, double& value) {
  skip_blanks(text);
  if (take_short_decimal(text, value)) return true;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && (stop == end || is_blank(*stop))) {
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return true;
  }
  std::string_view after = text;
  if (!parse_unusual_number(take_word(after), value)) return false;
  text = after;
  return true;
}

/// The same for integers.
template <class Integer>
bool take_integer(std::string_view& text, Integer& value) {
  skip_blanks(text);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || (stop != end && !is_blank(*stop))) return false;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return true;
}

/// The shortest text that reads back to the same value.
template <class Number>
void append(std::string& text, Number value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, error == std::errc() ? end : buffer);
}

}  // namespace marrow::text_detail
