// Words on standard error, and the words about versions.
#include <cstdio>

#include "command.hpp"

namespace marrow {

std::string one_line(std::string words) {
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return words;
}

void warn(const std::string& words) {
  std::fprintf(stderr, "marrow: warning: %s\n", one_line(words).c_str());
}

std::string program_version() { return MARROW_VERSION; }

std::string version_text() {
  return "marrow " MARROW_VERSION
         "\n"
         "with Embree " MARROW_EMBREE_VERSION ", TBB " MARROW_TBB_VERSION
         ", tinyobjloader " MARROW_TINYOBJLOADER_VERSION
         ",\n"
         "libpng " MARROW_PNG_VERSION ", nlohmann-json " MARROW_JSON_VERSION
         ", CLI11 " MARROW_CLI11_VERSION "\n";
}

}  // namespace marrow
