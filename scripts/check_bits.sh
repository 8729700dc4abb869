#!/usr/bin/env bash
# The same input gives the same bytes whatever the compiler did to the code: the hashes that the
# program `bits` prints, stage by stage, must agree between -O0, -O2, -O3 and -march=native.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

# bits_of NAME FLAGS: builds `bits` with FLAGS and keeps what it prints.
bits_of() {
  local name=$1 flags=$2 dir=build/bits/$1
  quietly "build/bits/$name.configure.log" cmake --preset release -B "$dir" \
    -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DMARROW_INSTALL=OFF
  quietly "build/bits/$name.build.log" cmake --build "$dir" --target bits
  "$dir/bin/bits" >"build/bits/$name.txt"
  [ -s "build/bits/$name.txt" ] || die "bits printed nothing"
}

first=
for flags in "-O0" "-O2" "-O3 -DNDEBUG" "-O3 -march=native -DNDEBUG"; do
  name=$(tr -d ' ' <<<"${flags#-}")
  say "bits under $flags"
  bits_of "$name" "$flags"
  first=${first:-$name}
  diff "build/bits/$first.txt" "build/bits/$name.txt" ||
    die "$flags changes the bits: see the stages above"
done
sha256sum "build/bits/$first.txt"
