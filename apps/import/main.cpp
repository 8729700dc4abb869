// The program `marrow-import`: a mesh on standard input, of a format that Assimp knows, as a binary
// PLY on standard output. It is started by `marrow`, so that what malformed files do to Assimp ends
// here: its exit statuses are those of marrow, its words one line without a name.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/shape_io.hpp>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "one_file.hpp"
#include "scene_shape.hpp"

namespace marrow {

namespace {

void set_limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  limit.rlim_max = limit.rlim_cur;
  ::setrlimit(resource, &limit);
}

/// What a file may cost: memory and output in proportion to its bytes, ten minutes of one
/// processor, and no file but those that are open.
void limit_process(std::size_t bytes) {
  constexpr rlim_t kBase = rlim_t{512} << 20, kPerByte = 64, kSeconds = 600, kFiles = 3;
  const rlim_t most = kBase + kPerByte * bytes;
#ifndef __SANITIZE_ADDRESS__  // its shadow is larger than any memory
  set_limit(RLIMIT_AS, most);
#endif
  set_limit(RLIMIT_FSIZE, most);
  set_limit(RLIMIT_CPU, kSeconds);
  set_limit(RLIMIT_NOFILE, kFiles);
  set_limit(RLIMIT_CORE, 0);
}

bool has_word(const char* words, const std::string& word) {
  for (std::string_view rest = words; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

/// Else a file's first bytes could choose any of fifty readers.
void keep_readers_of(const std::string& format, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    if (has_word(importer.GetImporterInfo(i)->mFileExtensions, format)) continue;
    importer.UnregisterLoader(reader);
    delete reader;
  }
}

/// The bytes that the header of a GLB tells must be there.
void check_glb(std::string_view bytes) {
  constexpr std::size_t kHeader = 12, kLengthAt = 8;
  if (!bytes.starts_with("glTF") || bytes.size() < kHeader)
    throw Error(ErrorKind::Malformed, "does not begin like a GLB file; export it again");
  std::uint32_t length = 0;
  for (std::size_t i = 4; i-- > 0;)
    length = length << 8 | static_cast<unsigned char>(bytes[kLengthAt + i]);
  if (length > bytes.size())
    throw Error(ErrorKind::Malformed, "has " + std::to_string(bytes.size()) + " bytes of the " +
                                          std::to_string(length) +
                                          " that its header tells; get it whole");
}

[[noreturn]] void refuse(const Assimp::Importer& importer, const std::string& other_name) {
  if (!other_name.empty())
    throw Error(ErrorKind::Unsupported, "needs another file, " + other_name +
                                            ", and no file that a file names is opened; export it "
                                            "as one file, or as PLY or OBJ");
  constexpr std::size_t kLongest = 200;
  throw Error(ErrorKind::Malformed,
              "cannot be read: " + std::string(importer.GetErrorString()).substr(0, kLongest) +
                  "; convert it to PLY or OBJ");
}

Shape import_shape(const std::string& format, std::string_view bytes, std::uint64_t max_triangles) {
  if (format == "glb") check_glb(bytes);
  Assimp::Importer importer;
  keep_readers_of(format, importer);
  const std::string name = "shape." + format;
  auto* const file = new OneFile(name, bytes);
  importer.SetIOHandler(file);  // which owns it from here
  const aiScene* const scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (!scene) refuse(importer, file->other_name());
  return shape_of_scene(*scene, max_triangles);
}

void run(int argc, char** argv) {
  std::uint64_t max_triangles = 0;
  if (argc != 3 ||
      std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), max_triangles).ec != std::errc{})
    throw Error(ErrorKind::Usage, "usage: marrow-import FORMAT MAX_TRIANGLES <FILE >PLY");
  const std::string bytes = read_file("-");
  limit_process(bytes.size());
  write_file("-", format_shape(import_shape(argv[1], bytes, max_triangles), ShapeFormat::Ply));
}

int fail(ErrorKind kind, const char* words) {
  std::fprintf(stderr, "%s\n", words);
  return static_cast<int>(kind);
}

}  // namespace

}  // namespace marrow

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";  // it would have to open files
}
#endif

int main(int argc, char** argv) {
  using namespace marrow;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // marrow may be told to end
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    run(argc, argv);
    return 0;
  } catch (const Error& e) {
    return fail(e.kind(), e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::Limit,
                "needs more memory than a file of its size may; convert it to PLY or OBJ");
  } catch (const std::exception& e) {
    return fail(ErrorKind::Malformed, e.what());
  }
}
