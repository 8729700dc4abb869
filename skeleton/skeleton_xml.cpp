#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "skeleton_xml_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr std::size_t kDeepest = 64;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// The character that `&name;` stands for; '\0' if it is none that we know.
char entity_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}}};
  for (const auto& [entity, character] : kEntities)
    if (entity == name) return character;
  return '\0';
}

}  // namespace

XmlReader::XmlReader(std::string_view text, Source source)
    : rest_(text), source_(std::move(source)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

void XmlReader::fail(const std::string& what) const {
  skeleton_detail::fail(source_.name, line_, what);
}

std::string_view XmlReader::take(std::size_t count) {
  const std::string_view taken = rest_.substr(0, count);
  next_line_ += static_cast<std::size_t>(std::count(taken.begin(), taken.end(), '\n'));
  rest_.remove_prefix(taken.size());
  return taken;
}

/// What stands before `end`, which is taken too.
std::string_view XmlReader::take_until(std::string_view end, const char* what) {
  const std::size_t found = rest_.find(end);
  if (found == std::string_view::npos) fail("the file ends within " + std::string(what));
  const std::string_view taken = take(found);
  take(end.size());
  return taken;
}

void XmlReader::skip_blanks() {
  std::size_t count = 0;
  while (count < rest_.size() && is_blank(rest_[count])) ++count;
  take(count);
}

std::string_view XmlReader::take_name() {
  std::size_t count = 0;
  while (count < rest_.size() && is_of_name(rest_[count])) ++count;
  if (count == 0) fail("no name behind '<' or between attributes");
  return take(count);
}

std::string XmlReader::decoded(std::string_view value) const {
  std::string result;
  while (!value.empty()) {
    const std::size_t plain = std::min(value.find('&'), value.size());
    result += value.substr(0, plain);
    value.remove_prefix(plain);
    if (value.empty()) break;
    const std::size_t end = value.find(';');
    const char character =
        end == std::string_view::npos ? '\0' : entity_of(value.substr(1, end - 1));
    if (character == '\0') fail(quoted(value.substr(0, end)) + " is no entity that is read here");
    result += character;
    value.remove_prefix(end + 1);
  }
  return result;
}

void XmlReader::read_attribute() {
  const std::string_view name = without_prefix(take_name());
  skip_blanks();
  if (peek() != '=') fail("the attribute " + quoted(name) + " has no value");
  take(1);
  skip_blanks();
  const char quote = peek();
  if (quote != '"' && quote != '\'') fail("the value of " + quoted(name) + " has no quotes");
  take(1);
  const std::string_view value = take_until({&quote, 1}, "the value of an attribute");
  if (value.find('<') != std::string_view::npos)
    fail("a '<' in the value of " + quoted(name) + "; is a quote missing?");
  attributes_.push_back({name, decoded(value)});
}

XmlReader::Event XmlReader::read_start() {
  const std::string_view name = take_name();
  if (open_.empty() && has_root_) fail("a second element behind the end of the first");
  has_root_ = true;
  attributes_.clear();
  for (;;) {
    skip_blanks();
    if (rest_.empty()) fail("the file ends within the element " + quoted(name));
    if (peek() == '>' || peek() == '/') break;
    read_attribute();
  }
  ends_at_once_ = peek() == '/';
  if (ends_at_once_) take(1);
  if (peek() != '>') fail("the element " + quoted(name) + " does not end in '>'");
  take(1);
  if (open_.size() == kDeepest)
    throw Error(ErrorKind::Unsupported, source_.name + ":" + std::to_string(line_) +
                                            ": elements stand more than " +
                                            std::to_string(kDeepest) + " deep in each other");
  open_.push_back(name);
  name_ = without_prefix(name);
  return Event::Start;
}

XmlReader::Event XmlReader::read_end() {
  const std::string_view name = take_name();
  skip_blanks();
  if (peek() != '>') fail("the end of " + quoted(name) + " does not end in '>'");
  take(1);
  if (open_.empty() || open_.back() != name)
    fail("the end of " + quoted(name) + (open_.empty() ? "" : " within " + quoted(open_.back())));
  open_.pop_back();
  name_ = without_prefix(name);
  return Event::End;
}

/// A comment or an instruction, if one is there.
bool XmlReader::pass_over() {
  if (rest_.starts_with("<!--")) {
    take(4);
    take_until("-->", "a comment");
    return true;
  }
  if (rest_.starts_with("<?")) {
    take_until("?>", "an instruction");
    return true;
  }
  if (rest_.starts_with("<!"))
    throw Error(ErrorKind::Unsupported, source_.name + ":" + std::to_string(line_) +
                                            ": a document type or CDATA; write the file without");
  return false;
}

XmlReader::Event XmlReader::next() {
  line_ = next_line_;
  if (std::exchange(ends_at_once_, false)) {
    open_.pop_back();
    return Event::End;
  }
  for (;;) {
    skip_blanks();
    line_ = next_line_;
    if (rest_.empty()) {
      if (!open_.empty()) fail("the file ends before the end of " + quoted(open_.back()));
      if (!has_root_) fail("the file has no element");
      return Event::EndOfFile;
    }
    if (peek() != '<') break;
    if (pass_over()) continue;
    take(1);
    if (peek() != '/') return read_start();
    take(1);
    return read_end();
  }
  if (open_.empty()) fail("text outside of the elements: this is no XML");
  text_line_ = line_;
  text_ = take(std::min(rest_.find('<'), rest_.size()));
  return Event::Text;
}

const std::string* XmlReader::attribute(std::string_view name) const {
  for (const Attribute& a : attributes_)
    if (a.name == name) return &a.value;
  return nullptr;
}

const std::string& XmlReader::required(std::string_view name) const {
  const std::string* value = attribute(name);
  if (value == nullptr)
    fail("the element " + quoted(name_) + " has no attribute '" + std::string(name) + "'");
  return *value;
}

void XmlReader::skip_element() {
  const std::size_t outside = depth() - 1;
  while (depth() != outside) next();
}

std::string_view XmlReader::element_text() {
  const std::string_view name = name_;
  std::string_view result;
  for (Event event = next(); event != Event::End; event = next()) {
    if (event == Event::Start) {
      skip_element();  // VTK has keys within its arrays
      continue;
    }
    if (!result.empty()) fail("the text of " + quoted(name) + " is in pieces");
    result = text_;
  }
  return result;
}

template <class Number>
std::vector<Number> XmlReader::element_numbers() {
  std::string_view all = element_text();
  std::vector<Number> numbers;
  std::size_t line = text_line_;
  for (;;) {
    const std::size_t begin = all.find_first_not_of(" \t\r\n");
    const std::string_view blanks = all.substr(0, begin);
    line += static_cast<std::size_t>(std::count(blanks.begin(), blanks.end(), '\n'));
    if (begin == std::string_view::npos) return numbers;
    all.remove_prefix(begin);
    const std::string_view word = all.substr(0, all.find_first_of(" \t\r\n"));
    if (!read_number(word, numbers.emplace_back()))
      skeleton_detail::fail(
          source_.name, line,
          quoted(word) +
              (std::is_same_v<Number, double> ? " is not a finite number" : " is not an index"));
    all.remove_prefix(word.size());
  }
}

template std::vector<double> XmlReader::element_numbers<double>();
template std::vector<std::uint64_t> XmlReader::element_numbers<std::uint64_t>();

}  // namespace marrow::skeleton_detail
