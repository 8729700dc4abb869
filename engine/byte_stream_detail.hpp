// The bytes of a file, inflated on the way if they are compressed.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace marrow::bytes_detail {

/// Whether `bytes` begin as gzip does.
bool is_gzip(std::string_view bytes);

class ByteStream {
 public:
  /// `bytes` must outlive this; with `compressed` they are gzip or zlib. `name` stands for the file
  /// in messages.
  ByteStream(std::string_view bytes, bool compressed, std::string name);

  /// Fills `into` with what comes next; returns how many bytes, less than asked for only at the
  /// end. Throws Error: Malformed (broken, or cut off).
  std::size_t read(std::span<char> into);

  /// Passes over so many bytes. False if there are not as many.
  bool skip(std::uint64_t count);

  /// No more bytes than these can follow: nothing need be allocated for more.
  std::uint64_t most_left() const;

 private:
  struct EndInflate {
    void operator()(z_stream* stream) const;
  };

  std::size_t inflate_into(std::span<char> into);
  void feed();

  std::string_view rest_;
  std::string name_;
  std::unique_ptr<z_stream, EndInflate> inflate_;  // none: not compressed
  bool is_at_end_ = false;                         // of the compressed data
};

}  // namespace marrow::bytes_detail
