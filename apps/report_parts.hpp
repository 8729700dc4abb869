// Pieces of the HTML report of a batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace marrow {

/// Text that stands for itself in HTML, between tags and in attributes.
std::string html_text(std::string_view text);

std::string base64(std::string_view bytes);

/// How many values fall between 1, 2, 5, 10, 20, ... times a power of ten.
class Histogram {
 public:
  void add(double value);
  /// A picture of bars; nothing if there are no values.
  std::string svg(const std::string& title, const std::string& unit) const;

 private:
  std::map<int, std::size_t> bins_;  ///< of the k-th of these numbers; zero and less in the first
};

/// Failures that differ in numbers and names only, counted, with a few of their ids.
class Causes {
 public:
  void add(const std::string& status, const std::string& error, const std::string& file,
           const std::string& id);
  /// A table, the most frequent cause first; nothing if there are none.
  std::string html() const;

 private:
  struct Cause {
    std::size_t count = 0;
    std::vector<std::string> ids;
  };
  std::map<std::string, Cause> causes_;
};

}  // namespace marrow
