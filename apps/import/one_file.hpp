// The only file that Assimp sees.
#pragma once

#include <assimp/IOSystem.hpp>

#include <string>
#include <string_view>

namespace marrow {

/// Serves the bytes of one file under one name. There are no others: whatever else a file names is
/// not opened, but remembered.
class OneFile : public Assimp::IOSystem {
 public:
  /// `bytes` must outlive this.
  OneFile(std::string name, std::string_view bytes);

  bool Exists(const char* path) const override;  // NOLINT(readability-identifier-naming)
  char getOsSeparator() const override;          // NOLINT(readability-identifier-naming)
  Assimp::IOStream* Open(const char* path,       // NOLINT(readability-identifier-naming)
                         const char* mode) override;
  void Close(Assimp::IOStream* stream) override;  // NOLINT(readability-identifier-naming)

  /// The first other file that was asked for; empty if none was.
  const std::string& other_name() const { return other_name_; }

 private:
  std::string name_;
  std::string_view bytes_;
  mutable std::string other_name_;
};

}  // namespace marrow
