#include "one_file.hpp"

#include <assimp/IOStream.hpp>
#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <utility>

namespace marrow {

OneFile::OneFile(std::string name, std::string_view bytes)
    : name_(std::move(name)), bytes_(bytes) {}

bool OneFile::Exists(const char* path) const {
  if (name_ == path) return true;
  if (other_name_.empty()) other_name_ = path;
  return false;
}

char OneFile::getOsSeparator() const { return '/'; }

Assimp::IOStream* OneFile::Open(const char* path, const char* mode) {
  if (!Exists(path) || std::string_view(mode).find_first_of("wa+") != std::string_view::npos)
    return nullptr;
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()),
                                    bytes_.size());
}

void OneFile::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace marrow
