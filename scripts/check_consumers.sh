#!/usr/bin/env bash
# Builds and runs the README's C++ program twice: against an installed Marrow (find_package), and with
# Marrow's sources in the same build (add_subdirectory). Needs a built release preset.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

marrow=$root/build/release/bin/marrow
work=$root/build/consumer
rm -rf "$work"
mkdir -p "$work"
"$marrow" make torus -o "$work/torus.obj"
"$marrow" extract "$work/torus.obj" -o "$work/expected.obj" --quiet

# consume NAME CMAKE-ARGUMENT...: builds tests/consumer, runs it, and looks at what it wrote.
consume() {
  local name=$1
  shift
  say "the README's program by $name"
  quietly "$work/$name.configure.log" cmake -S tests/consumer -B "$work/$name" -G Ninja "$@"
  quietly "$work/$name.build.log" cmake --build "$work/$name"
  [ "$("$work/$name/consumer" "$work/torus.obj" "$work/$name/skeleton.obj")" = "1 loops" ] ||
    die "the README's program does not see the loop of a torus"
  cmp "$work/$name/skeleton.obj" "$work/expected.obj"
}

quietly "$work/install.log" cmake --install build/release --prefix "$work/prefix"
consume find_package -DCMAKE_PREFIX_PATH="$work/prefix"
consume add_subdirectory -DMARROW_SOURCE="$root"
