// The lines of a manifest.
#include <marrow/error.hpp>

#include "batch_items.hpp"

namespace marrow {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& place, const std::string& words) {
  throw Error(ErrorKind::Malformed, place + ": " + words);
}

/// "min_part" -> "--min-part".
std::string option_of(const std::string& key) {
  std::string option = "--";
  for (const char c : key) option += c == '_' ? '-' : c;
  return option;
}

std::string text_of(const Json& value, const std::string& place) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  if (!value.is_array()) fail(place, "is no text, number, true, false or list of these");
  std::string text;
  for (const Json& item : value) {
    if (item.is_structured()) fail(place, "is a list of lists");
    text += (text.empty() ? "" : ",") + text_of(item, place);
  }
  return text;
}

std::string path_of(const std::string& path, const std::string& place) {
  if (path.empty()) fail(place, "there is no \"path\"; give each shape one");
  if (path.find('\0') != std::string::npos) fail(place, "the path holds a zero byte");
  return path;
}

}  // namespace

ManifestLine parse_manifest_line(const std::string& line, const std::string& place) {
  if (!line.starts_with('{')) return {path_of(line, place), "", {}};
  const Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded()) fail(place, "is not one JSON object");
  ManifestLine result;
  for (const auto& [key, value] : json.items()) {
    const std::string at = place + ": \"" + one_line(key) + "\"";
    if (key == "path" || key == "id") {
      if (!value.is_string()) fail(at, "is no text");
      (key == "path" ? result.path : result.id) = value.get<std::string>();
    } else {
      result.words.push_back(option_of(key) + "=" + text_of(value, at));
    }
  }
  path_of(result.path, place);
  return result;
}

}  // namespace marrow
