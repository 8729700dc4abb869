#include <marrow/error.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t begin = i;
    if (is_blank(line[i])) {
      ++i;
      continue;
    }
    while (i < line.size() && !is_blank(line[i])) ++i;
    words.push_back(line.substr(begin, i - begin));
  }
}

/// The whole word as a number; from_chars knows no locale and takes no leading plus.
template <typename Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw Error(ErrorKind::Malformed, name + ":" + std::to_string(line) + ": " + what);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return "'" + text + (word.size() > kLongest ? "...'" : "'");
}

Lines::Lines(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.substr(0, 3) == kByteOrderMark) rest_.remove_prefix(3);
}

bool Lines::next() {
  while (!rest_.empty()) {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    split(rest_.substr(0, end), words_);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

void Lines::expect(const std::string& what) {
  if (!next()) fail("the file ends before " + what);
}

std::string_view Lines::word(std::size_t i) const {
  if (i >= words_.size()) fail("the line has too few numbers");
  return words_[i];
}

double Lines::number(std::size_t i) const {
  double value = 0;
  if (!parse(word(i), value) || !std::isfinite(value))
    fail(quoted(words_[i]) + " is not a finite number");
  return value;
}

double Lines::radius(std::size_t i) const {
  const double value = number(i);
  if (!(value > 0)) fail("the radius " + quoted(words_[i]) + " is not greater than 0");
  return value;
}

std::uint64_t Lines::count(std::size_t i) const {
  std::uint64_t value = 0;
  if (!parse(word(i), value)) fail(quoted(words_[i]) + " is not a count");
  return value;
}

std::int64_t Lines::integer(std::size_t i) const {
  std::int64_t value = 0;
  if (!parse(word(i), value)) fail(quoted(words_[i]) + " is not an integer");
  return value;
}

void Lines::fail(const std::string& what) const { skeleton_detail::fail(name_, line_, what); }

void Lines::check_edge(NodeId a, NodeId b) const {
  if (a == b) fail("an edge from a node to itself");
}

void tidy_edges(CurveSkeleton& skeleton) {
  auto& edges = skeleton.edges;
  for (auto& e : edges)
    if (e[1] < e[0]) std::swap(e[0], e[1]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

void append(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append(std::string& text, std::uint64_t value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append(std::string& text, const CurveSkeleton::Node& node, std::string_view separator) {
  for (const double value : {node.position.x, node.position.y, node.position.z}) {
    append(text, value);
    text += separator;
  }
  append(text, node.radius);
}

}  // namespace marrow::skeleton_detail
