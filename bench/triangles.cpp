// The triangles of any shape that Marrow reads as an OFF file, so that all programs that are
// compared get the same:
//   marrow_triangles SHAPE OUT.off
#include <marrow/error.hpp>
#include <marrow/shape_io.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: marrow_triangles SHAPE OUT.off\n", stderr);
    return 2;
  }
  try {
    marrow::write_shape(argv[2], marrow::read_shape(argv[1]));
    return 0;
  } catch (const marrow::Error& e) {
    std::fprintf(stderr, "marrow_triangles: %s\n", e.what());
    return static_cast<int>(e.kind());
  }
}
