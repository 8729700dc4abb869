// What the readers of volumes share.
#pragma once

#include <marrow/volume.hpp>
#include <marrow/volume_io.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "byte_stream_detail.hpp"

namespace marrow::volume_detail {

/// A file to be read.
struct Source {
  std::string_view bytes;
  std::string path;  ///< for messages; detached data lie beside it
  const VolumeOptions& options;
};

// One per format. Throw Error: Malformed, Unsupported, Limit, CannotRead, Usage.
Volume parse_nrrd(const Source& source);
Volume parse_nifti(const Source& source);
Volume parse_binvox(const Source& source);
Volume parse_raw(const Source& source);

/// How the values of a file are written; what is compared is value * slope + intercept.
struct Samples {
  VoxelType type = VoxelType::U8;
  std::endian order = std::endian::little;
  double slope = 1, intercept = 0;
};

std::uint64_t bytes_of(VoxelType type);

/// Where the voxels lie, as a header says it.
struct Placement {
  std::array<std::uint64_t, 3> dims{};
  Vec3 origin;
  std::array<Vec3, 3> steps{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

/// A volume of background, after a check of all that a header can lie about: sizes against the
/// limits and against the most voxels that the file can hold, steps that span no space.
/// Throws Error: Malformed, Limit.
Volume make_volume(const Placement& placement, std::uint64_t most_voxels, const Source& source);

/// Sets the flags of a volume one by one, x fastest.
class FlagWriter {
 public:
  explicit FlagWriter(Volume& volume) : volume_(volume), word_(volume.bits.data()) {}

  /// Flags still to come.
  std::uint64_t left() const {
    return rows_left() * static_cast<std::uint64_t>(volume_.nx) - static_cast<std::uint64_t>(x_);
  }

  /// Up to 64 flags, the first in bit 0, that stay within a row: see room().
  void put(Volume::Word flags, int count) {
    const int at = x_ & 63;
    *word_ |= flags << at;
    if (at + count > 64) word_[1] |= flags >> (64 - at);
    word_ += (at + count) >> 6;
    x_ += count;
    if (x_ == volume_.nx) {
      if ((x_ & 63) != 0) ++word_;
      x_ = 0;
      ++rows_done_;
    }
  }
  /// Flags until the end of the row.
  int room() const { return volume_.nx - x_; }

  /// `count` times the same flag.
  void put_run(bool flag, std::uint64_t count);

 private:
  std::uint64_t rows_left() const {
    return static_cast<std::uint64_t>(volume_.ny) * static_cast<std::uint64_t>(volume_.nz) -
           rows_done_;
  }

  Volume& volume_;
  Volume::Word* word_;
  int x_ = 0;
  std::uint64_t rows_done_ = 0;
};

/// Reads the values of all voxels: foreground is what is greater than options.iso. Whether more
/// bytes follow. Throws Error: Malformed (too few values, broken compressed data).
bool read_samples(Volume& volume, bytes_detail::ByteStream& stream, const Samples& samples,
                  const Source& source);

[[noreturn]] void fail(ErrorKind kind, const Source& source, const std::string& what);

}  // namespace marrow::volume_detail
