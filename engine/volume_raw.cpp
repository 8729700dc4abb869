#include <marrow/error.hpp>

#include <array>

#include "byte_stream_detail.hpp"
#include "volume_detail.hpp"

namespace marrow::volume_detail {

Volume parse_raw(const Source& source) {
  const VolumeOptions& o = source.options;
  if (o.dims == std::array<std::uint64_t, 3>{})
    fail(ErrorKind::Usage, source, "a raw file does not say its sizes; give them by --dims");
  bytes_detail::ByteStream stream(source.bytes, bytes_detail::is_gzip(source.bytes), source.path);
  const Placement placement{
      o.dims, {}, {Vec3{o.spacing.x, 0, 0}, Vec3{0, o.spacing.y, 0}, Vec3{0, 0, o.spacing.z}}};
  Volume volume = make_volume(placement, stream.most_left() / bytes_of(o.type), source);
  if (read_samples(volume, stream, {o.type, o.order}, source))
    fail(ErrorKind::Malformed, source,
         "holds more bytes than voxels of this type need; mend the sizes or the type");
  return volume;
}

}  // namespace marrow::volume_detail
