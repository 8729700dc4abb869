// Lines, words and numbers of the text formats of curve-skeletons.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace marrow::skeleton_detail {

/// Throws Error(Malformed, "name:line: what").
[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what);

/// `word` between quotes, cut and without control characters, so that a message stays one line.
std::string quoted(std::string_view word);

/// A text, read line by line; each line split at blanks. Ends of line may be LF or CR LF.
class Lines {
 public:
  Lines(std::string_view text, std::string name);

  /// Goes to the next line that has a word; false at the end of the text.
  bool next();
  /// The same, but the end of the text is an error: "the file ends before `what`".
  void expect(const std::string& what);

  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t line() const { return line_; }  ///< from 1
  /// The bytes that no line has used yet: a bound for any count that a header claims.
  std::size_t bytes_left() const { return rest_.size(); }

  double number(std::size_t word) const;  ///< finite, the whole word
  double radius(std::size_t word) const;  ///< > 0
  std::uint64_t count(std::size_t word) const;
  std::int64_t integer(std::size_t word) const;

  [[noreturn]] void fail(const std::string& what) const;
  /// Refuses an edge from a node to itself.
  void check_edge(NodeId a, NodeId b) const;

 private:
  std::string_view word(std::size_t i) const;

  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
};

/// Lower id first, sorted, every edge once: files may list an edge at both its ends.
void tidy_edges(CurveSkeleton& skeleton);

/// The shortest text that reads back to the same double, whatever the locale.
void append(std::string& text, double value);
void append(std::string& text, std::uint64_t value);
/// x, y, z and radius with `separator` between them.
void append(std::string& text, const CurveSkeleton::Node& node, std::string_view separator);

// One pair per format; the readers throw Error(Malformed) or Error(Unsupported).
std::string format_obj(const CurveSkeleton& skeleton);
std::string format_skel(const CurveSkeleton& skeleton);
std::string format_ply(const CurveSkeleton& skeleton);
std::string format_json(const CurveSkeleton& skeleton);
CurveSkeleton parse_obj(std::string_view bytes, const std::string& name);
CurveSkeleton parse_skel(std::string_view bytes, const std::string& name);
CurveSkeleton parse_ply(std::string_view bytes, const std::string& name);
CurveSkeleton parse_json(std::string_view bytes, const std::string& name);

}  // namespace marrow::skeleton_detail
