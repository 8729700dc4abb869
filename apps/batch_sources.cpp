// Files, folders, globs and manifests as lists of shapes.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "batch_items.hpp"

namespace marrow {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_read(const std::string& name, const std::string& why) {
  throw Error(ErrorKind::CannotRead, name + ": cannot be read: " + why);
}

/// Whether a file in a folder is taken for a shape. Texts and tables may be anything, and what is
/// in a raw volume nobody knows: they are to be named.
bool looks_like_a_shape(const std::string& name) {
  static const std::vector<std::string> known = [] {
    std::vector<std::string> formats = input_formats();
    std::erase(formats, "raw");
    formats.insert(formats.end(), {"pts", "nhdr"});
    return formats;
  }();
  const std::string extension = input_format_of(name);

  return std::find(known.begin(), known.end(), extension) != known.end();
}

/// The shapes below `folder`, sorted; links to folders are not followed.
std::vector<std::string> shapes_below(const std::string& folder, const std::string& without) {
  std::vector<std::string> paths;
  std::error_code error, ignored;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (at->is_directory(ignored)) {
      if (fs::equivalent(at->path(), without, ignored)) at.disable_recursion_pending();
    } else if (at->is_regular_file(ignored) && looks_like_a_shape(at->path().filename().string())) {
      paths.push_back(at->path().string());
    }
  }
  if (error) cannot_read(folder, error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> matches_of(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (paths.empty()) cannot_read(pattern, "there is no such file");
  return paths;
}

void add_path(const std::string& path, const std::string& without, ItemList& list) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return list.add(path);
  for (const std::string& shape : shapes_below(path, without)) list.add(shape);
}

void add_lines(std::istream& in, const std::string& name, ItemList& list) {
  constexpr std::size_t kLongest = std::size_t{1} << 20;
  std::uint64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string place = name + ":" + std::to_string(++number);
    if (line.size() > kLongest) throw Error(ErrorKind::Malformed, place + ": is longer than 1 MiB");
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) list.add(parse_manifest_line(line, place), place);
  }
  if (in.bad()) cannot_read(name, "it breaks off");
}

void add_manifest(const std::string& path, ItemList& list) {
  if (path == "-") return add_lines(std::cin, "standard input", list);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) cannot_read(path, "it is a folder");
  std::ifstream in(path, std::ios::binary);
  if (!in) cannot_read(path, std::error_code(errno, std::generic_category()).message());
  add_lines(in, path, list);
}

}  // namespace

void add_sources(const BatchSources& sources, ItemList& list) {
  for (const std::string& input : sources.inputs) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(input, ignored))) {
      add_path(input, sources.without, list);
    } else {
      for (const std::string& path : matches_of(input)) add_path(path, sources.without, list);
    }
  }
  if (!sources.manifest.empty()) add_manifest(sources.manifest, list);
}

}  // namespace marrow
