#!/usr/bin/env bash
# What the program does at limits, on full disks and when it is killed: never half an output.
#
#   tests/hardening_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

small=$work/small   # a disk that is soon full
trap 'mountpoint -q "$small" && umount "$small"; rm -rf "$work"' EXIT

quick=(--image 96 --grid 32 --quiet)
"$marrow" make torus -o torus.obj --resolution 0.5 || exit 1
"$marrow" extract torus.obj -o skeleton.obj "${quick[@]}" || exit 1
bytes=$(stat -c %s torus.obj)
faces=$(grep -c '^f' torus.obj)

# --- limits ---------------------------------------------------------------------------------------
bad 7 "torus.obj: is larger than the limit of $((bytes - 1)) bytes; raise --max-file" \
  extract torus.obj -o out.obj --max-file $((bytes - 1))
bad 7 'limit of 2048 bytes; raise --max-file' info torus.obj --max-file 2K
bad 7 'limit of 2048 bytes; raise --max-file' info skeleton.obj --max-file 2048
bad 7 'raise --max-file' render torus.obj skeleton.obj -o out.png --max-file 1K
bad 7 'limit of 0 bytes' info torus.obj --max-file 0
bad 7 "torus.obj: holds more triangles than the limit of $((faces - 1)); raise --max-faces" \
  extract torus.obj -o out.obj --max-faces $((faces - 1))
bad 7 'raise --max-faces' info torus.obj --max-faces 1
bad 7 'raise --max-faces' render torus.obj skeleton.obj -o out.png --max-faces 1
"$marrow" info torus.obj --max-faces "$faces" --max-file "$bytes" >stdout || fail "limits are too narrow"
"$marrow" make torus -o torus.nrrd --voxels 32 || exit 1
read -r nx ny nz < <(sed -n 's/^sizes: //p' torus.nrrd)
voxels=$(((nx + 63) / 64 * 64 * ny * nz))   # a row counts as a multiple of 64
bad 7 "torus.nrrd: has $nx x $ny x $nz voxels, more than the limit of $((voxels - 1))" \
  extract torus.nrrd -o out.obj --max-voxels $((voxels - 1))
for verb in info 'render -o out.png'; do
  # shellcheck disable=SC2086
  bad 7 'raise --max-voxels' $verb torus.nrrd --max-voxels 1
done
"$marrow" info torus.nrrd --max-voxels "$voxels" >stdout || fail "the limit of voxels is too narrow"
bad 2 '--max-voxels' info torus.nrrd --max-voxels -1
"$marrow" info torus.obj --max-file 1G >stdout || fail "no G"
"$marrow" extract - --from obj -o out.obj --max-file 1000 <torus.obj 2>stderr
status=$?
refused 7 'standard input: is larger than the limit of 1000 bytes' 'extract -'
for wrong in -1 many 1X '' 99999999999G; do
  bad 2 '--max-file' info torus.obj --max-file "$wrong"
done
bad 2 '--max-faces' info torus.obj --max-faces -1
bad 2 '--timeout' info torus.obj --timeout -1
for verb in batch extract info render; do
  "$marrow" "$verb" --help >stdout
  for option in '--max-file SIZE' '--max-faces N' '--max-voxels N' '--timeout SECONDS'; do
    grep -qF -- "$option" stdout || fail "$verb --help does not tell of $option"
  done
done

# --- time -----------------------------------------------------------------------------------------
mkfifo pipe.obj
# One end of our own, so that nobody ever sees the end of the file.
exec 3<>pipe.obj
bad 7 'pipe.obj: took longer than the limit of 1 s; raise --timeout' \
  extract pipe.obj -o out.skel --timeout 1
bad 7 'raise --timeout' info pipe.obj --timeout 1
bad 7 'raise --timeout' render pipe.obj skeleton.obj -o out.png --timeout 1
"$marrow" info - --from obj --timeout 1 <&3 >stdout 2>stderr
status=$?
refused 7 'standard input: took longer' 'info -'
exec 3>&-
rm pipe.obj
"$marrow" info torus.obj --timeout 0 >stdout || fail "no time at all"

# --- parts ----------------------------------------------------------------------------------------
"$marrow" make rings -o rings.obj --resolution 0.5
for part in --largest '--min-part 100' '--min-part 0'; do
  # shellcheck disable=SC2086  # an option and its value
  "$marrow" extract rings.obj -o rings.skel --image 128 --grid 64 $part 2>>stderr || fail "$part"
done
grep -qE 'components 1, cycles 1,' stderr || fail "--largest does not leave one ring: $(cat stderr)"
grep -qE 'components 3, cycles 3,' stderr || fail "--min-part 0 does not leave all: $(cat stderr)"
bad 2 '--min-part' extract rings.obj -o out.obj --min-part 101
bad 2 '--largest' extract rings.obj -o out.obj --min-part 10 --largest

# --- killed ---------------------------------------------------------------------------------------
# killed MOMENT COMMAND...: kills the command at that moment; out.x is absent, old, or as in `whole`.
killed() {
  local moment=$1
  shift
  "$@" 2>/dev/null &
  local program=$!
  "$moment" "$program"
  kill -9 "$program" 2>/dev/null
  wait "$program" 2>/dev/null
  if [ -e out.x ] && ! cmp -s out.x whole && ! cmp -s out.x old; then
    fail "killed: half an output of $(stat -c %s out.x) bytes"
  fi
  rm -f .marrow-*
}
# Callbacks of killed.
# shellcheck disable=SC2317,SC2329
some_time() { sleep "0.$(printf %03d $((RANDOM % longest)))"; }
# shellcheck disable=SC2317,SC2329
while_writing() {
  until compgen -G '.marrow-*' >/dev/null || ! kill -0 "$1" 2>/dev/null; do :; done
}

# killed_often COMMAND...: its last word, the output, comes behind it.
killed_often() {
  local begin try
  begin=$(date +%s%N)
  "$@" whole || fail "$*"
  longest=$((($(date +%s%N) - begin) / 1000000 + 1))   # milliseconds
  [ "$longest" -lt 999 ] || longest=999
  for try in 1 2 3 4 5 6 7 8 9 10; do
    rm -f out.x
    [ $((try % 2)) -eq 0 ] || cp old out.x
    killed some_time "$@" out.x
    killed while_writing "$@" out.x
  done
  rm -f out.x
}

echo old >old
killed_often "$marrow" make torus --to obj -o
killed_often "$marrow" extract torus.obj "${quick[@]}" --to json -o

# --- a full disk ----------------------------------------------------------------------------------
full_disk() {
  mkdir -p "$small"
  mount -t tmpfs -o size=4k tmpfs "$small" 2>mount.log || {
    echo "skipped: a full disk, because no disk can be mounted here: $(cat mount.log)"
    return
  }
  echo old >"$small/old.obj"   # all there is room for
  bad 8 'small/new.obj: cannot be written: No space left' make torus -o small/new.obj
  bad 8 'small/old.obj: cannot be written: No space left' make torus -o small/old.obj
  bad 8 'small/new.obj: cannot be written: No space left' extract torus.obj -o small/new.obj "${quick[@]}"
  bad 8 'small/new.png: cannot be written: No space left' render torus.obj skeleton.obj -o small/new.png
  bad 8 'No space left' extract torus.obj -o out.obj --json small/new.json --trace out_stages "${quick[@]}"
  cmp -s "$small/old.obj" old || fail "the old file on the full disk has changed"
  [ "$(ls -A "$small")" = old.obj ] || fail "left on the full disk: $(ls -A "$small")"
  umount "$small"
}
full_disk

# The same by a limit on the size of files, which needs no mount.
(ulimit -f 4 && "$marrow" make torus -o out.obj 2>stderr)
status=$?
refused 8 'out.obj: cannot be written: File too large' 'make torus'

finish "nothing is ever half written"
