#include "report_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace marrow {

namespace {

constexpr std::size_t kMostIds = 5, kMostCauses = 100;

/// The k-th number of ..., 0.5, 1, 2, 5, 10, ...; 1 is the 0th.
double edge_of(int k) {
  const int decade = k >= 0 ? k / 3 : -((2 - k) / 3);
  double value = k - 3 * decade == 0 ? 1 : k - 3 * decade == 1 ? 2 : 5;
  for (int i = 0; i < decade; ++i) value *= 10;
  for (int i = 0; i > decade; --i) value /= 10;
  return value;
}

std::string short_number(double value) {
  char digits[32];
  const char* const suffix = value >= 1e9 ? "G" : value >= 1e6 ? "M" : value >= 1e3 ? "k" : "";
  const double scaled = value >= 1e9   ? value / 1e9
                        : value >= 1e6 ? value / 1e6
                        : value >= 1e3 ? value / 1e3
                                       : value;
  std::snprintf(digits, sizeof digits, "%.3g%s", scaled, suffix);
  return digits;
}

std::string rectangle(double x, double y, double width, double height) {
  char text[128];
  std::snprintf(text, sizeof text, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>",
                x, y, width, height);
  return text;
}

std::string label(double x, double y, const std::string& words) {
  char place[64];
  std::snprintf(place, sizeof place, "<text x=\"%.1f\" y=\"%.1f\">", x, y);
  return place + html_text(words) + "</text>";
}

/// The words without the name in front, with N for numbers.
std::string cause_of(const std::string& error, const std::string& file) {
  std::string_view words = error;
  if (!file.empty() && words.starts_with(file)) words.remove_prefix(file.size());
  while (!words.empty() && (words[0] == ':' || words[0] == ' ')) words.remove_prefix(1);
  std::string cause;
  for (const char c : words) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit) cause += c;
    if (is_digit && !cause.ends_with('N')) cause += 'N';
  }
  return cause;
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j)
      bits = bits << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += j <= count ? kDigits[bits >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

void Histogram::add(double value) {
  constexpr int kLeast = -18, kMost = 45;  // a millionth to 10 to the 15
  if (!std::isfinite(value)) return;
  int k = kLeast;
  while (k < kMost && edge_of(k + 1) <= value) ++k;
  ++bins_[k];
}

std::string Histogram::svg(const std::string& title, const std::string& unit) const {
  if (bins_.empty()) return "";
  constexpr double kBar = 36, kHeight = 100, kTop = 16, kFoot = 16;
  const int first = bins_.begin()->first, last = bins_.rbegin()->first;
  std::size_t most = 0;
  for (const auto& [k, count] : bins_) most = std::max(most, count);
  const double width = kBar * (last - first + 2), height = kTop + kHeight + kFoot;
  std::string bars;
  for (int k = first; k <= last + 1; ++k) {
    const double x = kBar * (k - first) + kBar / 2;
    bars += label(x, height - 3, short_number(edge_of(k)));
    const auto bin = bins_.find(k);
    if (bin == bins_.end()) continue;
    const double size = kHeight * static_cast<double>(bin->second) / static_cast<double>(most);
    bars += rectangle(x, kTop + kHeight - size, kBar - 1, size);
    bars += label(x + kBar / 2, kTop + kHeight - size - 3, std::to_string(bin->second));
  }
  char head[128];
  std::snprintf(head, sizeof head, "<svg width=\"%.0f\" height=\"%.0f\" role=\"img\">", width,
                height);
  return "<figure class=\"histogram\"><figcaption>" + html_text(title) + ", " + html_text(unit) +
         "</figcaption>" + head + bars + "</svg></figure>\n";
}

void Causes::add(const std::string& status, const std::string& error, const std::string& file,
                 const std::string& id) {
  Cause& cause = causes_[status + ": " + cause_of(error, file)];
  ++cause.count;
  if (cause.ids.size() < kMostIds) cause.ids.push_back(id);
}

std::string Causes::html() const {
  using Entry = std::map<std::string, Cause>::const_iterator;
  std::vector<Entry> sorted;
  for (auto at = causes_.begin(); at != causes_.end(); ++at) sorted.push_back(at);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](Entry a, Entry b) { return a->second.count > b->second.count; });
  if (sorted.empty()) return "";
  std::string html = "<table><tr><th>Failures</th><th>Cause</th><th>Shapes</th></tr>\n";
  for (std::size_t i = 0; i < std::min(sorted.size(), kMostCauses); ++i) {
    const auto& [words, cause] = *sorted[i];
    html += "<tr><td>" + std::to_string(cause.count) + "</td><td>" + html_text(words) + "</td><td>";
    for (const std::string& id : cause.ids) html += html_text(id) + "<br>";
    html += cause.count > cause.ids.size() ? "…</td></tr>\n" : "</td></tr>\n";
  }
  html += "</table>\n";
  if (sorted.size() > kMostCauses)
    html +=
        "<p>" + std::to_string(sorted.size() - kMostCauses) + " rarer causes are left out.</p>\n";
  return html;
}

}  // namespace marrow
