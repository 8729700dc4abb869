#!/usr/bin/env bash
# Runs the program as a shell does: exit statuses, what is said where, what is left behind.
#
#   tests/cli_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

# silent ARGUMENT...: must succeed without a word on either stream.
silent() {
  good "$@"
  if [ -s stdout ] || [ -s stderr ]; then fail "marrow $*: says something"; fi
}

quick=(--image 96 --grid 32 --quiet)

# --- words about itself ---------------------------------------------------------------------------
good --version
says '^marrow [0-9]+\.[0-9]+\.[0-9]+$'
says 'Embree [0-9]'
says 'TBB [0-9]'
good --help
says 'Exit status'
for verb in batch extract compare convert info check make map merge render view; do
  good "$verb" --help
  says 'Examples:'
  [ ! -s stderr ] || fail "help on standard error"
done
good make --list
says '^torus '

# --- make, extract, info, render ------------------------------------------------------------------
silent make torus -o torus.obj --truth torus.gt.json --resolution 0.5
good info torus.obj
says '^kind +shape'
says '^closed +yes'
says '^handles +1'
grep -q '"polyline_xyzr"' torus.gt.json || fail "no truth"
for format in ply stl off; do
  silent make torus -o "torus.$format" --resolution 0.5
  good info "torus.$format" --json
  says '"handles": 1'
done
silent make torus -o again.obj --truth truth.skel --resolution 0.5
same torus.obj again.obj
good info truth.skel
says '^cycles +1'

for format in obj skel ply json; do
  silent extract torus.obj -o "skeleton.$format" "${quick[@]}"
  good info "skeleton.$format"
  sed '1d; /^section radius/d' stdout >"info.$format"  # an .obj has none
  says '^kind +skeleton'
  says '^cycles +1'
  says '^leaves +0'
  same info.obj "info.$format"
done
good extract torus.obj -o skeleton.obj --image 96 --grid 32
[ ! -s stdout ] || fail "words on standard output"
grep -q 'torus.obj -> skeleton.obj: .*cycles 1,' stderr || fail "no word about the result: $(cat stderr)"
silent render torus.obj skeleton.skel -o picture.png --size 320x240
[ "$(head -c 4 picture.png | tail -c 3)" = PNG ] || fail "no picture"

silent render torus.obj -o shape.png --size 320x240 --view front
silent render torus.obj skeleton.skel -o dark.png --size 320x240 --background black
cmp -s dark.png picture.png && fail "black is white"
silent render skeleton.skel -o lines.svg --view three-quarter --background '#102030'
grep -q '<line ' lines.svg || fail "no lines in the SVG"
grep -q 'fill="#102030"' lines.svg || fail "no background in the SVG"
grep -q 'id="side"' lines.svg && fail "more than one view in the SVG"
silent render torus.obj skeleton.skel -o both.svg --size 320x240
[ "$(grep -c '^<g ' both.svg)" -eq 4 ] || fail "not four views in the SVG"
silent render --sheet torus.obj skeleton.skel torus.ply skeleton.json skeleton.ply -o sheet.png
silent render --sheet torus.obj skeleton.skel torus.ply skeleton.json skeleton.ply -o again.png
same sheet.png again.png

# --- check: figures, and gates with a status of their own -----------------------------------------
good check torus.obj truth.skel --same-topology --components 1 --cycles 1 --max-outside 0 \
  --max-centredness 0.05 --max-reconstruction 0.3 --min-coverage 99 --max-radius-error 0.2
says '^shape cycles +1'
says '^outside percent +0$'
[ ! -s stderr ] || fail "words about a good skeleton: $(cat stderr)"
good check torus.obj skeleton.obj --json
says '"outside_percent": 0.0,'
says '"shape_cycles": 1,'
cp stdout figures.json
"$marrow" check torus.obj - --from skel --json <skeleton.skel | sed 's/standard input/skeleton.obj/' |
  cmp -s - figures.json || fail "check in a pipe"
awk '$1 == "v" { $2 *= 1.3 } 1' skeleton.obj >moved.obj
run check torus.obj moved.obj --max-outside 1 --max-centredness 0.2 --max-radius-error 1
says '^outside percent +[1-9]'
refused 10 'moved.obj: outside ' "check of a moved skeleton"
for words in 'is more than 1 %; centredness' 'is more than 0.2; radius error'; do
  refused 10 "$words" "check of a moved skeleton"
done
printf 'v 1 0 0 1\nv -1 0 0 1\nv 0 1 0 1\nl 1 2 3\n' >line.obj
run check torus.obj line.obj --same-topology
refused 10 'line.obj: cycles 0 instead of 1' "check of a line"
run check torus.obj line.obj --cycles 0 --components 2 --min-coverage 99
refused 10 'is less than 99 %; components 1 instead of 2' "check of a line"
bad 2 'standard input' check - - --from obj
bad 2 '--max-outside' check torus.obj line.obj --max-outside -1
bad 4 'torus.obj' check torus.obj torus.obj
printf 'v 1e30 0 0 1\nv 0 0 0 1\nl 1 2\n' >away.obj
bad 4 'away.obj: a node lies' check torus.obj away.obj

# --- volumes --------------------------------------------------------------------------------------
silent make torus -o torus.nrrd --voxels 40
good info torus.nrrd
says '^kind +volume'
says '^voxels +42 42 12'
says '^tunnels +1'
good check torus.nrrd truth.skel --same-topology
silent extract torus.nrrd -o voxels.obj "${quick[@]}" --json voxels.json
good info voxels.obj
says '^cycles +1'
grep -q '"foreground"' voxels.json || fail "no voxels in the JSON"
"$marrow" make torus -o - --to nrrd --voxels 40 | cmp -s - torus.nrrd || fail "make to a pipe"
"$marrow" extract - --from nrrd -o - --to obj "${quick[@]}" <torus.nrrd | cmp -s - voxels.obj ||
  fail "a volume from a pipe"
silent render torus.nrrd voxels.obj -o volume.png --size 320x240
# The same voxels without a header, plain and compressed.
header=$(awk '{ n += length($0) + 1 } /^$/ { print n; exit }' torus.nrrd)
tail -c "+$((header + 1))" torus.nrrd | gunzip >torus.raw
gzip -n <torus.raw >packed.raw.gz
for file in torus.raw packed.raw.gz; do
  good info "$file" --dims 42,42,12 --spacing 1,1,2
  says '^tunnels +1'
  says '^spacing +1 1 2'
done
bad 2 "--dims" extract torus.raw -o out.obj
bad 2 "three numbers" extract torus.raw -o out.obj --dims 42,42
bad 2 "three numbers" extract torus.raw -o out.obj --dims 42,42,12,
bad 2 "nan" extract torus.raw -o out.obj --dims 42,42,12 --iso nan
bad 4 "mend the sizes" extract torus.raw -o out.obj --dims 42,42,11
bad 4 "mend the sizes" extract torus.raw -o out.obj --dims 42,42,13
bad 4 "cut off" extract <(head -c 300 packed.raw.gz) -o out.obj --from raw --dims 42,42,12
bad 6 "--iso" extract torus.nrrd -o out.obj --iso 1
bad 2 "no inside" make gingerbread-man -o out.nrrd
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 42 42 12\nencoding: raw\ndata file: torus.raw\n' >torus.nhdr
silent extract torus.nhdr -o again.obj "${quick[@]}"
mkdir inner
sed 's/torus.raw/..\/torus.raw/' torus.nhdr >inner/torus.nhdr
bad 5 "beside the header" extract inner/torus.nhdr -o out.obj
sed 's/torus.raw/none.raw/' torus.nhdr >inner/torus.nhdr
bad 3 "inner/none.raw" extract inner/torus.nhdr -o out.obj

# --- the same bytes -------------------------------------------------------------------------------
for threads in 1 3 8; do
  silent extract torus.obj -o again.obj --threads "$threads" "${quick[@]}"
  same skeleton.obj again.obj
done

bad 2 "no instruction set MMX" extract torus.obj -o out.obj --simd MMX
for simd in $(tail -n 1 stderr | sed 's/.*one of //; s/,//g'); do
  silent extract torus.obj -o again.obj --simd "$simd" "${quick[@]}"
  same skeleton.obj again.obj
done

# --- two ways to silhouettes ----------------------------------------------------------------------
silent extract torus.obj -o again.obj --silhouettes scanline --json statistics.json "${quick[@]}"
same skeleton.obj again.obj
grep -q '"silhouettes": "scanline"' statistics.json || fail "no word about scanlines"
for threads in 1 8; do
  silent extract torus.obj -o "rays.$threads.obj" --silhouettes embree --threads "$threads" \
    --json statistics.json "${quick[@]}"
  grep -q '"silhouettes": "embree"' statistics.json || fail "no word about Embree"
done
grep -q '"surface scene"' statistics.json || fail "Embree was not asked"
same rays.1.obj rays.8.obj
good info rays.1.obj
says '^cycles +1'

# --- the paper's own rules --------------------------------------------------------------------------
silent extract torus.obj -o paper.obj --rules paper --json statistics.json "${quick[@]}"
grep -q '"refine": "none"' statistics.json || fail "the paper's rules refine"
good info paper.obj
says '^kind +skeleton'
silent extract torus.obj -o again.obj --rules paper --refine none --threads 1 --trace paper_stages "${quick[@]}"
same paper.obj again.obj
[ -e paper_stages/09_looped.obj ] || fail "no graph of the loops: $(ls paper_stages)"
silent extract torus.obj -o again.obj --rules marrow "${quick[@]}"
same skeleton.obj again.obj

# --- viewpoints -----------------------------------------------------------------------------------
silent extract torus.obj -o again.obj --views 21 --json statistics.json "${quick[@]}"
same skeleton.obj again.obj
grep -q '"views": 21' statistics.json || fail "no word about the views"
silent extract torus.obj -o views.obj --views 81 "${quick[@]}"
good info views.obj
says '^cycles +1'
printf '1 0 0\n0 1 0  # sideways\n0 0 1\n\n1 1 1\n-1 1 1\n' >views.txt
silent extract torus.obj -o views.obj --views views.txt --json statistics.json "${quick[@]}"
grep -q '"views": 5' statistics.json || fail "no word about the views"
printf '1 0 0\n0 1\n' >few.txt
bad 4 'few.txt:2: ' extract torus.obj -o out.obj --views few.txt
bad 3 'none.txt' extract torus.obj -o out.obj --views none.txt

# --- standard input and output --------------------------------------------------------------------
"$marrow" extract - --from obj -o - --to skel "${quick[@]}" <torus.obj >piped.skel || fail "pipe"
same skeleton.skel piped.skel
"$marrow" make torus -o - --to ply --resolution 0.5 | cmp -s - torus.ply || fail "make to a pipe"
"$marrow" render - skeleton.obj --from obj -o - --size 320x240 <torus.obj | cmp -s - picture.png ||
  fail "render in a pipe"
"$marrow" render torus.obj - --from skel -o - --size 320x240 <skeleton.skel |
  cmp -s - picture.png || fail "render in a pipe"
"$marrow" info - --from skel <skeleton.skel | grep -q '^cycles *1' || fail "info in a pipe"
cp torus.obj odd.name
silent extract odd.name --from obj -o odd.skeleton --to skel "${quick[@]}"
same skeleton.skel odd.skeleton

# --- statistics -----------------------------------------------------------------------------------
good extract torus.obj -o skeleton.obj --json - "${quick[@]}"
says '"cycles": 1'
says '"total_seconds"'
sed '/"run"/,$d' stdout >statistics
silent extract torus.obj -o skeleton.obj --json statistics.json --threads 1 "${quick[@]}"
sed '/"run"/,$d' statistics.json | cmp -s - statistics || fail "statistics are not the same twice"

# --- trace ----------------------------------------------------------------------------------------
silent extract torus.obj -o again.obj --trace stages "${quick[@]}"
same skeleton.obj again.obj
same skeleton.obj stages/13_skeleton.obj
for file in stages/*.obj; do good info "$file"; done
[ "$(find stages -name '*.png' | wc -l)" -ge 5 ] || fail "no pictures of the stages"

# --- what a file is -------------------------------------------------------------------------------
printf 'v 0 0 0 1\nv 1 0 0 1\nl 1 2\n' >lines.obj
good info lines.obj
says '^kind +skeleton'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n' >both.obj
good info both.obj
says '^kind +shape'
says '^open edges +3'
says '^closed +no'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 -1 0\nf 1 2 3\nf 4 5 6\nv 9 9 9\n' >soup.obj
good info soup.obj
says '^components +1'
says '^unused points +1'
says '^bounds +0 -1 0 to 1 1 0'

# --- point clouds ---------------------------------------------------------------------------------
grep '^v' torus.obj | cut -c3- >cloud.xyz
good info cloud.xyz
says '^kind +points'
says '^triangles +0'
silent extract cloud.xyz -o cloud.obj --trace cloud_stages "${quick[@]}"
good info cloud.obj
says '^cycles +1'
silent extract cloud.xyz -o closed.obj --closing 4 "${quick[@]}"
good check cloud.xyz cloud.obj
says '^outside percent +n/a'
says '^coverage percent +[1-9]'
run check cloud.xyz cloud.obj --max-outside 1 --same-topology
refused 10 'outside cannot be told' "check against a cloud"
good render cloud.xyz cloud.obj -o cloud.png
printf '1 2 3\n' >one.xyz
bad 6 'coincide' extract one.xyz -o out.obj
bad 2 '--closing' extract cloud.xyz -o out.obj --closing 25

# --- failures, each with its status ---------------------------------------------------------------
touch nothing.obj
printf 'v 0 0 0\nv 1 0 0\nf 1 2 99\n' >broken.obj
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >point.obj
cp torus.obj torus.blend
mkdir folder.obj

bad 2 'a verb is missing; see marrow --help'
bad 2 'explode is not a verb of marrow; see marrow --help' explode
bad 2 'see marrow extract --help' extract
bad 2 '--output is required' extract torus.obj
bad 2 '--wrong' extract torus.obj -o out.obj --wrong
bad 2 '1024' extract torus.obj -o out.obj --image 63
bad 2 '--image' extract torus.obj -o out.obj --image many
bad 2 '--image' extract torus.obj -o out.obj --image 99999999999
bad 2 '256' extract torus.obj -o out.obj --grid 257
bad 2 '--threads' extract torus.obj -o out.obj --threads -1
bad 2 '--silhouettes' extract torus.obj -o out.obj --silhouettes rays
bad 2 '--from' extract - -o out.obj
bad 2 '--to' extract torus.obj -o -
bad 2 '--from' extract torus.obj -o out.obj --from blend
bad 2 'twice' extract torus.obj -o - --to obj --json -
bad 2 'twice' extract torus.obj -o out.obj --json out.obj
bad 2 'is the input' extract torus.obj -o torus.obj
bad 2 'is the input' extract torus.obj -o ./torus.obj
bad 2 'empty' extract torus.obj -o ''
bad 2 'NAME is missing' make
bad 2 'missing' make torus
bad 2 'no-such-shape' make no-such-shape -o out.obj
bad 2 'resolution' make torus -o out.obj --resolution 0
bad 2 'no limbs to bend; take one of y ' make torus -o out.obj --pose 1
bad 2 '--size' render torus.obj skeleton.obj -o out.png --size 20x20
bad 2 '--size' render torus.obj skeleton.obj -o out.png --size 800
bad 2 '--background' render torus.obj skeleton.obj -o out.png --background '#12345'
bad 2 '--background' render torus.obj skeleton.obj -o out.png --background red
bad 2 '--view' render torus.obj skeleton.obj -o out.png --view below
bad 2 '--sheet' render torus.obj skeleton.obj torus.ply -o out.png
bad 5 'a sheet is' render --sheet torus.obj -o out.svg
bad 2 'standard input' render - - --from obj -o out.png
bad 3 'none.obj' extract none.obj -o out.obj
bad 3 'folder.obj' info folder.obj
bad 4 'broken.obj:3' extract broken.obj -o out.obj
bad 4 'torus.obj' render torus.obj torus.obj -o out.png
bad 4 'not JSON' info torus.obj --from json
bad 5 'torus.blend' extract torus.blend -o out.obj
bad 5 'out.fbx' extract torus.obj -o out.fbx
bad 5 'out.jpg' render torus.obj skeleton.obj -o out.jpg
bad 5 'out.gltf' make torus -o out.gltf
bad 5 'out.txt' make torus -o out.obj --truth out.txt
bad 6 'nothing.obj' extract nothing.obj -o out.obj
bad 6 'point.obj' extract point.obj -o out.obj "${quick[@]}"
bad 8 'no folder' extract torus.obj -o none/out.obj
bad 8 'no folder' make torus -o none/out.obj
bad 8 'no folder' extract torus.obj -o skeleton.obj --trace none/stages
bad 8 'torus.obj' extract torus.obj -o out.skel --trace torus.obj
bad 8 'folder.obj' extract torus.obj -o folder.obj "${quick[@]}"
if [ -e /dev/full ]; then
  bad 8 '/dev/full' extract torus.obj -o /dev/full --to obj --json out.json --trace out_stages "${quick[@]}"
  "$marrow" make --list >/dev/full 2>stderr
  [ $? -eq 8 ] || fail "a full standard output"
fi
bad 3 'new line.obj' info $'new\nline.obj'

# --- told to end ----------------------------------------------------------------------------------
# A reader that goes away is no failure to talk about.
{
  "$marrow" make torus -o - --to obj 2>stderr
  echo $? >status
} | head -c 1 >stdout
[ "$(cat status)" -eq 8 ] || fail "exit status $(cat status) when nobody reads"
[ ! -s stderr ] || fail "words when nobody reads: $(cat stderr)"

# interrupted SIGNAL STATUS: ends the program while it waits for standard input.
interrupted() {
  mkfifo input
  # A shell makes what it starts in the background ignore SIGINT.
  env --default-signal=INT "$marrow" extract - --from obj -o out.obj <input >stdout 2>stderr &
  local program=$!
  exec 3>input   # returns when the program has opened the other end
  sleep 0.2
  kill -s "$1" "$program"
  wait "$program"
  status=$?
  exec 3>&-
  rm input
  [ "$status" -eq "$2" ] || fail "exit status $status instead of $2 after SIG$1"
  left_behind "SIG$1"
}
interrupted INT 130
interrupted TERM 143
interrupted HUP 129

finish "the program does what it says"
