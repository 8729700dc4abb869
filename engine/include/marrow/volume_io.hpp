// Reading and writing volumes: NRRD, NIfTI-1, binvox, raw.
#pragma once

#include <marrow/volume.hpp>

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace marrow {

enum class VolumeFormat { Nrrd, Nifti, Binvox, Raw };

enum class VoxelType { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

struct VolumeOptions {
  double iso = 0;  ///< a voxel whose value is greater is foreground; not a number never is
  /// Of raw files, whose bytes do not say it: voxels along x, y and z (x runs fastest), the type of
  /// their values and its byte order, and the distance between voxels along the axes. The centre of
  /// the first voxel is (0, 0, 0).
  std::array<std::uint64_t, 3> dims{};
  VoxelType type = VoxelType::U8;
  std::endian order = std::endian::little;
  Vec3 spacing{1, 1, 1};
  std::uint64_t max_bytes = std::uint64_t{4} << 30;   ///< larger files are refused (Limit)
  std::uint64_t max_voxels = std::uint64_t{1} << 31;  ///< more are refused (Limit); rows count as
                                                      ///< multiples of 64 voxels
};

/// The format that the extension of `path` names, none if it is none of a volume: .nrrd .nhdr .nii
/// .binvox .raw, and .nii.gz .raw.gz.
std::optional<VolumeFormat> volume_format_of(const std::string& path);

/// Reads a volume; its extension names its format.
/// - NRRD: attached and detached headers, raw, gzip and text encodings, all types of numbers.
///   Positions come from "space directions" and "space origin", else from "spacings"; "axis mins"
///   are passed over. A detached data file must lie beside its header.
/// - NIfTI-1 in one file, also compressed: positions by sform, else qform, else pixdim; values are
///   scaled by scl_slope and scl_inter before they are compared.
/// - binvox: positions by its scale and translation.
/// - raw, also compressed: see VolumeOptions.
/// No other file is ever opened. Nothing is allocated for voxels that the bytes cannot hold.
/// Throws Error: CannotRead, Malformed, Unsupported, Limit, Usage (raw without dims).
Volume read_volume(const std::string& path, const VolumeOptions& options = {});

/// The same from bytes in memory. `path` stands for the file in messages, and a detached data file
/// is looked for beside it.
Volume parse_volume(std::string_view bytes, VolumeFormat format, const std::string& path,
                    const VolumeOptions& options = {});

/// Bytes of an NRRD file that reads back to the same volume: 0 and 1 as uint8, compressed.
std::string format_nrrd(const Volume& volume);

}  // namespace marrow
