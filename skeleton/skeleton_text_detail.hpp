// Lines, words and numbers of the text formats of curve-skeletons.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace marrow::skeleton_detail {

/// What a reader knows of a file besides its bytes.
struct Source {
  std::string name;           ///< for messages
  double missing_radius = 0;  ///< of nodes that have none; 0: such nodes are refused
};

/// Throws Error(Malformed, "name:line: what").
[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what);

/// `word` between quotes, cut and without control characters, so that a message stays one line.
std::string quoted(std::string_view word);

/// `radius` where it is given, else that of the source; "" or the words for why there is none.
std::string check_radius(double& radius, bool is_given, const Source& source);
/// "" or the words for what is wrong with a section radius.
std::string check_section_radius(double section_radius, double radius);

/// The whole word as a number, whatever the locale; false when it is none or not finite.
bool read_number(std::string_view word, double& value);
bool read_number(std::string_view word, std::int64_t& value);
bool read_number(std::string_view word, std::uint64_t& value);

/// The words of `line`, which stand apart by blanks.
void split(std::string_view line, std::vector<std::string_view>& words);

/// A text, read line by line; each line split at blanks, or at `separator` if there is one. Ends of
/// line may be LF or CR LF.
class Lines {
 public:
  Lines(std::string_view text, Source source, char separator = '\0');

  /// Goes to the next line that has a word; false at the end of the text.
  bool next();
  /// The same, but the end of the text is an error: "the file ends before `what`".
  void expect(const std::string& what);

  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t line() const { return line_; }  ///< from 1
  /// The bytes that no line has used yet: a bound for any count that a header claims.
  std::size_t bytes_left() const { return rest_.size(); }

  double number(std::size_t word) const;  ///< finite, the whole word
  double radius(std::size_t word) const;  ///< > 0; that of the source if there is no such word
  double section_radius(std::size_t word, double radius) const;  ///< 0 or at least `radius`
  std::uint64_t count(std::size_t word) const;
  std::int64_t integer(std::size_t word) const;

  [[noreturn]] void fail(const std::string& what) const;
  /// Refuses an edge from a node to itself.
  void check_edge(NodeId a, NodeId b) const;

 private:
  std::string_view word(std::size_t i) const;

  std::string_view rest_;
  Source source_;
  char separator_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
};

/// The ids that a file gives its nodes, in the order of the nodes: any numbers, each once.
class NodeIds {
 public:
  void add(std::int64_t id, std::size_t line);
  /// When all are there. Throws Error: Malformed (an id that is given twice).
  void sort(const Source& source);
  /// After sort(). `what` is the word for a node that line `line` names.
  NodeId find(std::int64_t id, const char* what, std::size_t line, const Source& source) const;

 private:
  struct Entry {
    std::int64_t id;
    std::size_t line;
    NodeId node;
  };
  std::vector<Entry> entries_;
};

/// Lower id first, sorted, every edge once: files may list an edge at both its ends.
void tidy_edges(CurveSkeleton& skeleton);

/// The shortest text that reads back to the same double, whatever the locale.
void append(std::string& text, double value);
void append(std::string& text, std::uint64_t value);
/// x, y, z and radius with `separator` between them.
void append(std::string& text, const CurveSkeleton::Node& node, std::string_view separator);

/// Whether a section radius is known at any node.
bool has_section_radii(const CurveSkeleton& skeleton);

// One pair per format; the readers throw Error(Malformed) or Error(Unsupported).
std::string format_obj(const CurveSkeleton& skeleton);
std::string format_skel(const CurveSkeleton& skeleton);
std::string format_ply(const CurveSkeleton& skeleton);
std::string format_json(const CurveSkeleton& skeleton);
std::string format_cg(const CurveSkeleton& skeleton);
std::string format_graph(const CurveSkeleton& skeleton);
std::string format_swc(const CurveSkeleton& skeleton);
std::string format_polylines(const CurveSkeleton& skeleton);
std::string format_vtp(const CurveSkeleton& skeleton);
std::string format_graphml(const CurveSkeleton& skeleton);
std::string format_csv(const CurveSkeleton& skeleton);
std::string format_dot(const CurveSkeleton& skeleton);
std::string format_glb(const CurveSkeleton& skeleton);
CurveSkeleton parse_obj(std::string_view bytes, const Source& source);
CurveSkeleton parse_skel(std::string_view bytes, const Source& source);
CurveSkeleton parse_ply(std::string_view bytes, const Source& source);
CurveSkeleton parse_json(std::string_view bytes, const Source& source);
CurveSkeleton parse_cg(std::string_view bytes, const Source& source);
CurveSkeleton parse_graph(std::string_view bytes, const Source& source);
CurveSkeleton parse_swc(std::string_view bytes, const Source& source);
CurveSkeleton parse_polylines(std::string_view bytes, const Source& source);
CurveSkeleton parse_vtp(std::string_view bytes, const Source& source);
CurveSkeleton parse_graphml(std::string_view bytes, const Source& source);
CurveSkeleton parse_csv(std::string_view bytes, const Source& source);

}  // namespace marrow::skeleton_detail
