#!/usr/bin/env bash
# The same input gives the same bytes whatever the compiler did to the code: the hashes that the
# program `bits` prints, stage by stage, are those of tests/golden/bits.txt under -O0, -O2 and
# -O3 -march=native. (Under -O3, and under the sanitizers, the test `bits` says so.)

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

for flags in "-O0" "-O2" "-O3 -march=native -DNDEBUG"; do
  name=$(tr -d ' ' <<<"${flags#-}")
  say "bits under $flags"
  quietly "build/bits/$name.configure.log" cmake --preset release -B "build/bits/$name" \
    -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DMARROW_BUILD_APPS=OFF
  quietly "build/bits/$name.build.log" cmake --build "build/bits/$name" --target bits
  diff tests/golden/bits.txt <("build/bits/$name/bin/bits") ||
    die "$flags changes the bits of the stages above"
done
