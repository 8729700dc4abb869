#include <algorithm>
#include <limits>

#include "text_detail.hpp"

namespace marrow::text_detail {

namespace {

/// How many digits stand before the point of 0.ddd... x 10^k: positive for numbers of 1 and more.
/// `word` is a number without a sign.
std::int64_t decimal_exponent(std::string_view word) {
  constexpr std::int64_t kHuge = std::int64_t{1} << 40;
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const std::string_view digits = word.substr(0, e);
  std::string_view power = word.substr(std::min(e + 1, word.size()));
  std::int64_t exponent = 0;
  if (power.starts_with('+')) power.remove_prefix(1);
  const auto [stop, error] = std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (error == std::errc::result_out_of_range) exponent = power.starts_with('-') ? -kHuge : kHuge;
  exponent = std::clamp(exponent, -kHuge, kHuge);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = std::min(digits.find_first_of("123456789"), digits.size());
  const auto before = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  return exponent + (first < point ? before : before + 1);
}

}  // namespace

void fail(ErrorKind kind, const std::string& name, const std::string& place,
          const std::string& what) {
  throw Error(kind, name + ":" + (place.empty() ? "" : place + ":") + " " + what);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest))
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return text + (word.size() > kLongest ? "...'" : "'");
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
    if (at == 0 || is_blank(line[at - 1])) return line.substr(0, at);
  return line;
}

bool has_control_characters(std::string_view text) {
  // Without a way out, so that the loop works on many bytes at once.
  unsigned found = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    found |= static_cast<unsigned>(byte < 0x20) & static_cast<unsigned>(byte < 9 || byte > 13);
  }
  return found != 0;
}

void check_is_text(std::string_view text, const std::string& name) {
  if (has_control_characters(text))
    fail(ErrorKind::Malformed, name, "",
         "holds control characters and is not a text; check that its extension is right");
}

Lines::Lines(std::string_view text) : rest_(text) {
  std::size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return;
  end = text.find_first_not_of('\r', end);
  if (end == std::string_view::npos || text[end] != '\n') end_of_line_ = '\r';
}

bool parse_unusual_number(std::string_view word, double& value) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return false;
  }
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return false;
  if (error == std::errc()) return true;
  const bool negative = word.starts_with('-');
  if (negative) word.remove_prefix(1);
  value = decimal_exponent(word) > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  if (negative) value = -value;
  return true;
}

}  // namespace marrow::text_detail
