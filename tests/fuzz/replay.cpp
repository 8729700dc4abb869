// Feeds every file of the folders it is given to the fuzz target that it is linked with, for
// compilers that have no fuzzer:
//
//   fuzz_NAME FOLDER...
#include <marrow/file_io.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::string> files_of(int count, char** folders) {
  std::vector<std::string> files;
  for (int i = 0; i < count; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(folders[i]))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto files = files_of(argc - 1, argv + 1);
    for (const auto& file : files) {
      std::fprintf(stderr, "%s\n", file.c_str());  // the last one is the one to blame for a crash
      const std::string bytes = marrow::read_file(file);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    if (files.empty()) std::fprintf(stderr, "no inputs: nothing was tested\n");
    return files.empty() ? 1 : 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
