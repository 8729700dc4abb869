#include <marrow/error.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view word) {
  while (!word.empty() && is_blank(word.front())) word.remove_prefix(1);
  while (!word.empty() && is_blank(word.back())) word.remove_suffix(1);
  return word;
}

/// Fields between separators, without blanks around them and without quotes; none of a blank line.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  if (trimmed(line).empty()) return;
  for (;;) {
    const std::size_t end = line.find(separator);
    std::string_view field = trimmed(line.substr(0, end));
    if (field.size() > 1 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
    fields.push_back(field);
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
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

bool read_number(std::string_view word, double& value) {
  return parse(word, value) && std::isfinite(value);
}

bool read_number(std::string_view word, std::int64_t& value) { return parse(word, value); }

bool read_number(std::string_view word, std::uint64_t& value) { return parse(word, value); }

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

std::string check_radius(double& radius, bool is_given, const Source& source) {
  if (!is_given && !(source.missing_radius > 0))
    return "a node without a radius; give one for all that have none (marrow convert --radius R)";
  if (!is_given) radius = source.missing_radius;
  if (radius > 0) return "";
  std::string number;
  append(number, radius);
  return "the radius " + quoted(number) + " is not greater than 0";
}

std::string check_section_radius(double section_radius, double radius) {
  if (section_radius == 0 || section_radius >= radius) return "";
  std::string number;
  append(number, section_radius);
  return "the section radius " + quoted(number) + " is neither 0 nor at least the radius";
}

Lines::Lines(std::string_view text, Source source, char separator)
    : rest_(text), source_(std::move(source)), separator_(separator) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.substr(0, 3) == kByteOrderMark) rest_.remove_prefix(3);
}

bool Lines::next() {
  while (!rest_.empty()) {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    if (separator_ == '\0')
      split(rest_.substr(0, end), words_);
    else
      split_fields(rest_.substr(0, end), separator_, words_);
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
  if (!read_number(word(i), value)) fail(quoted(words_[i]) + " is not a finite number");
  return value;
}

double Lines::radius(std::size_t i) const {
  const bool is_given = i < words_.size();
  double value = is_given ? number(i) : 0;
  const std::string fault = check_radius(value, is_given, source_);
  if (!fault.empty()) fail(fault);
  return value;
}

double Lines::section_radius(std::size_t i, double radius) const {
  const double value = number(i);
  const std::string fault = check_section_radius(value, radius);
  if (!fault.empty()) fail(fault);
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

void Lines::fail(const std::string& what) const {
  skeleton_detail::fail(source_.name, line_, what);
}

void Lines::check_edge(NodeId a, NodeId b) const {
  if (a == b) fail("an edge from a node to itself");
}

void NodeIds::add(std::int64_t id, std::size_t line) {
  entries_.push_back({id, line, static_cast<NodeId>(entries_.size())});
}

void NodeIds::sort(const Source& source) {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::pair{a.id, a.node} < std::pair{b.id, b.node};
  });
  for (std::size_t i = 1; i < entries_.size(); ++i)
    if (entries_[i].id == entries_[i - 1].id)
      skeleton_detail::fail(source.name, entries_[i].line,
                            "the id " + std::to_string(entries_[i].id) + " is given twice");
}

NodeId NodeIds::find(std::int64_t id, const char* what, std::size_t line,
                     const Source& source) const {
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), id,
                                      [](const Entry& e, std::int64_t i) { return e.id < i; });
  if (found == entries_.end() || found->id != id)
    skeleton_detail::fail(source.name, line,
                          what + (" " + std::to_string(id)) + " is no id of this file");
  return found->node;
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

bool has_section_radii(const CurveSkeleton& skeleton) {
  return std::any_of(skeleton.nodes.begin(), skeleton.nodes.end(),
                     [](const auto& node) { return node.section_radius != 0; });
}

}  // namespace marrow::skeleton_detail
