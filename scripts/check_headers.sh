#!/usr/bin/env bash
# Every public header compiles alone.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

say "every public header alone"
quietly build/headers.configure.log cmake --preset release -B build/headers \
  -DCMAKE_VERIFY_INTERFACE_HEADER_SETS=ON -DMARROW_BUILD_APPS=OFF -DMARROW_BUILD_TESTS=OFF
quietly build/headers.build.log cmake --build build/headers --target all_verify_interface_header_sets
