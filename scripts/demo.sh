#!/usr/bin/env bash
# From a shape to its curve-skeleton and a picture of both.
#
#   scripts/demo.sh            a four-legged animal that the program makes itself
#   scripts/demo.sh SHAPE      your shape: .obj, .ply, .stl or .off
#
# Everything it makes is in build/demo.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

case "${1-}" in
  -h | --help) sed -n '2,/^$/s/^# \{0,1\}//p' "$0"; exit ;;
esac
[ $# -le 1 ] || die "one shape at a time; usage: scripts/demo.sh [SHAPE]"
shape=${1-}
if [ -n "$shape" ]; then
  [ -f "$shape" ] || die "$shape: there is no such file; name a .obj, .ply, .stl or .off file"
  shape=$(realpath "$shape")
fi

"$root/scripts/setup.sh"
say "building (a few minutes the first time)"
build release marrow_program

marrow=$root/build/release/bin/marrow
out=$root/build/demo
mkdir -p "$out"
cd "$out"
if [ -z "$shape" ]; then
  shape=quadruped.ply
  say "making a four-legged animal"
  "$marrow" make quadruped -o "$shape"
fi
name=$(basename "$shape")
name=${name%.*}

say "the shape"
"$marrow" info "$shape"

say "extracting its curve-skeleton"
"$marrow" extract "$shape" -o "$name.skeleton.obj"
"$marrow" extract "$shape" -o "$name.skel" --quiet
"$marrow" info "$name.skeleton.obj"

say "drawing the picture"
"$marrow" render "$shape" "$name.skeleton.obj" -o "$name.png"

say "done; look at"
echo "the shape and the skeleton inside it:       $out/$name.png"
echo "the skeleton (v x y z radius, l i j):       $out/$name.skeleton.obj"
echo "the same in the format of the authors:      $out/$name.skel"
