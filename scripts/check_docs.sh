#!/usr/bin/env bash
# The C++ reference is made without a warning, in build/docs/html.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

command -v doxygen >/dev/null || die "doxygen is missing; scripts/setup.sh --dev installs it"
mkdir -p build
quietly build/docs.log doxygen docs/Doxyfile
echo "build/docs/html/index.html"
