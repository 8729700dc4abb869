// The shapes of a batch: from folders, globs, files and a manifest.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "batch_ids.hpp"
#include "extraction.hpp"

namespace marrow {

/// What the command line says, or a line of a manifest in its place.
struct ShapeOptions {
  ExtractionRequest extraction;
  std::string from;  ///< format, whatever the extension
};

struct BatchItem {
  std::string path, id;
  std::uint32_t options = 0;  ///< index into BatchItems::options
};

struct BatchItems {
  std::vector<BatchItem> items;
  std::vector<ShapeOptions> options;  ///< the first is the command line's
};

/// Shape j of the whole list is of the shard j modulo `count`.
struct Shard {
  std::uint64_t index = 0, count = 1;

  bool has(std::uint64_t j) const { return j % count == index; }
};

/// "0/8" to "7/8". Throws Error: Usage.
Shard shard_of(const std::string& text);

/// One line of a manifest: a path, or a JSON object with "path" and what else differs: "id",
/// "from", and options of the command line by their names, like "min_part".
struct ManifestLine {
  std::string path, id;
  std::vector<std::string> words;  ///< the options as words of a command line
};

/// Throws Error: Malformed, beginning with `place`.
ManifestLine parse_manifest_line(const std::string& line, const std::string& place);

/// A list that grows line by line and keeps what is of a shard.
class ItemList {
 public:
  ItemList(const Shard& shard, ShapeOptions base);

  void add(const std::string& path);
  /// Throws Error: Malformed, beginning with `place`.
  void add(const ManifestLine& line, const std::string& place);

  std::uint64_t size() const { return seen_; }  ///< of all shards
  BatchItems take() && { return std::move(list_); }

 private:
  void keep(const std::string& path, std::string id, std::uint32_t options);
  std::uint32_t options_of(const ManifestLine& line, const std::string& place);

  Shard shard_;
  UniqueIds ids_;
  std::uint64_t seen_ = 0;
  std::map<std::string, std::uint32_t> known_options_;
  BatchItems list_;
};

/// Where the shapes come from.
struct BatchSources {
  std::vector<std::string> inputs;  ///< files, folders and globs
  std::string manifest;             ///< a file, "-" for standard input, or none
  std::string without;              ///< a folder that is no source: where the results go
};

/// All shapes, those of a folder by name. Throws Error: CannotRead, Malformed, Usage.
void add_sources(const BatchSources& sources, ItemList& list);

}  // namespace marrow
