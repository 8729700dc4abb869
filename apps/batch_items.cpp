#include "batch_items.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <charconv>

namespace marrow {

namespace {

/// The options of a line on top of `base`, read as a command line is.
ShapeOptions parse_options(std::vector<std::string> words, ShapeOptions base,
                           const std::string& place) {
  CLI::App parser;
  parser.set_help_flag();
  add_extraction_options(parser, base.extraction);
  add_format_option(parser, "--from", base.from, "", input_formats());
  std::reverse(words.begin(), words.end());  // as the parser wants them
  try {
    parser.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    throw Error(ErrorKind::Malformed, place + ": " + e.what());
  }
  return base;
}

}  // namespace

Shard shard_of(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
  const auto count = std::from_chars(has_slash ? index.ptr + 1 : end, end, shard.count);
  if (count.ec != std::errc{} || count.ptr != end || shard.index >= shard.count)
    throw Error(ErrorKind::Usage,
                "--shard: " + one_line(text) + " is not one of 0/N to N-1/N, like 0/8");
  return shard;
}

ItemList::ItemList(const Shard& shard, ShapeOptions base) : shard_(shard) {
  list_.options.push_back(std::move(base));
}

void ItemList::add(const std::string& path) { keep(path, id_of(path), 0); }

void ItemList::add(const ManifestLine& line, const std::string& place) {
  const std::string& name = line.id.empty() ? line.path : line.id;
  keep(line.path, id_of(name), line.words.empty() ? 0 : options_of(line, place));
}

void ItemList::keep(const std::string& path, std::string id, std::uint32_t options) {
  id = ids_.add(std::move(id));
  if (shard_.has(seen_++)) list_.items.push_back({path, std::move(id), options});
}

std::uint32_t ItemList::options_of(const ManifestLine& line, const std::string& place) {
  std::string key;
  for (const std::string& word : line.words) key += word + '\n';
  const auto [at, is_new] =
      known_options_.try_emplace(key, static_cast<std::uint32_t>(list_.options.size()));
  if (is_new) list_.options.push_back(parse_options(line.words, list_.options[0], place));
  return at->second;
}

}  // namespace marrow
