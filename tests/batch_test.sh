#!/usr/bin/env bash
# A batch and its merged results: whatever happens to it, one final row for each shape, and the same
# bytes.
#
#   tests/batch_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

quick=(--image 64)
options=(--grid 16)

# rows_of DIR: id, status and error of each row, by id, in the file called rows.
rows_of() {
  "$marrow" merge "$1" -o - | sed -E 's/^\{"id":"([^"]*)".*"status":"([^"]*)"(,"error":"([^"]*)")?.*/\1 \2 \4/' >rows
}

# row WORDS: the rows in the file `rows` hold one like this.
row() {
  grep -qE -- "^$1" rows || fail "no row '$1': $(cat rows)"
}

# batch STATUS ARGUMENT...: a batch that must end so.
batch() {
  local expected=$1
  shift
  run batch "${quick[@]}" "${options[@]}" "$@"
  [ "$status" -eq "$expected" ] || fail "marrow batch $*: exit status $status: $(cat stderr)"
}

# said WORDS: standard error of the last run has them.
said() {
  grep -qE -- "$1" stderr || fail "nobody says '$1': $(cat stderr)"
}

# merged DIR...: what merge makes of these, as merged.jsonl.
merged() {
  good merge "$@" -o merged.jsonl
}

mkdir shapes shapes/more
"$marrow" make capsule -o shapes/capsule.obj --resolution 0.5 || exit 1
"$marrow" make torus -o shapes/torus.ply --resolution 0.5 || exit 1
"$marrow" make y -o shapes/more/y.off --resolution 0.5 || exit 1
"$marrow" make torus -o shapes/more/torus.nrrd --voxels 24 || exit 1
echo 'v 1 2' >shapes/broken.obj
: >shapes/empty.ply
echo 'no shape' >shapes/more/README.txt

# --- a folder -------------------------------------------------------------------------------------
batch 9 shapes -o whole --format skel,json --render
said '^whole: done 4, failed 2 \(empty 1, malformed 1\); '
good merge whole -o whole.jsonl -o whole.csv -o whole.html
rows_of whole
[ "$(wc -l <rows)" -eq 6 ] || fail "not six rows: $(cat rows)"
row 'shapes/broken.obj malformed shapes/broken.obj:1: '
row 'shapes/empty.ply empty shapes/empty.ply: is empty'
row 'shapes/more/y.off done'
grep -q '"id":"shapes/torus.ply".*"triangles":[0-9]*}.*"cycles":1,' whole.jsonl || fail "no counts"
grep -q '"id":"shapes/more/torus.nrrd".*"voxels":\[' whole.jsonl || fail "no voxels"
! grep -q '"run"' whole.jsonl || fail "a merged row tells of the run"
good merge whole -o - --with-run
says '"run":\{"ended":[0-9.e+]+,"attempt":1,"host":.*"max_rss":[0-9]+.*"seconds":\{"read":'
good extract shapes/torus.ply -o torus.skel "${quick[@]}" "${options[@]}"
same torus.skel whole/skeletons/shapes/torus.ply.skel
[ "$(head -c 4 whole/pictures/shapes/capsule.obj.png | tail -c 3)" = PNG ] || fail "no picture"
[ "$(find whole -type f | wc -l)" -eq 13 ] || fail "other files than expected: $(find whole -type f)"
[ ! -e whole/.work-0-of-1 ] || fail "the work folder stays"

# --- merged ---------------------------------------------------------------------------------------
head -n 1 whole.csv | grep -q '^id,status,error,' || fail "no line of names"
[ "$(wc -l <whole.csv)" -eq 7 ] || fail "not seven lines: $(cat whole.csv)"
grep -q '^shapes/torus.ply,done,,.*fnv1a64:' whole.csv || fail "$(cat whole.csv)"
[ "$(grep -o 'src="data:image/png;base64,' whole.html | wc -l)" -eq 4 ] || fail "not four pictures"
! grep -qE 'src="[^d]|href|<script' whole.html || fail "the report needs other files"
[ "$(grep -o '<svg' whole.html | wc -l)" -eq 4 ] || fail "not four histograms"
good merge whole -o few.html --pictures 1
[ "$(grep -o '<img' few.html | wc -l)" -eq 1 ] || fail "not one picture"
mkdir two
echo '{"id":"a","status":"new","run":{"ended":5}}' >two/results-0-of-2.jsonl
echo '{"id":"a","status":"old","run":{"ended":4}}' >two/results-1-of-2.jsonl
good merge two -o -
[ "$(cat stdout)" = '{"id":"a","status":"new"}' ] || fail "not the last row: $(cat stdout)"
bad 3 'nowhere: cannot be read' merge nowhere -o out.jsonl
bad 2 'holds no results' merge shapes -o out.jsonl
bad 5 'out.txt: merged results are' merge whole -o out.txt

# --- any jobs, any shards -------------------------------------------------------------------------
outputs=(--format "skel,json" --render)
batch 9 --jobs 1 shapes -o parts "${outputs[@]}" --shard 2/3
batch 9 --jobs 1 shapes -o parts "${outputs[@]}" --shard 0/3
batch 0 --jobs 3 shapes -o parts "${outputs[@]}" --shard 1/3
merged parts
same merged.jsonl whole.jsonl
diff -r parts/skeletons whole/skeletons >stdout || fail "other skeletons by shards: $(cat stdout)"
diff -r parts/pictures whole/pictures >stdout || fail "other pictures by shards"
batch 0 shapes -o parts --shard 7/8 --resume "${outputs[@]}"
for wrong in 3/3 1 a/b 1/0 -1/2; do
  bad 2 '--shard' batch shapes -o out "--shard=$wrong"
done

batch 0 shapes/capsule.obj -o maps --format skel,skel,polylines --map csv
[ "$(find maps -type f | sort | tr '\n' ' ')" = "maps/maps/shapes/capsule.obj.csv \
maps/results-0-of-1.jsonl maps/skeletons/shapes/capsule.obj.polylines.txt \
maps/skeletons/shapes/capsule.obj.skel " ] || fail "other files than asked for: $(find maps)"
good extract shapes/capsule.obj -o capsule.skel --map capsule.csv "${quick[@]}" "${options[@]}"
same capsule.csv maps/maps/shapes/capsule.obj.csv
bad 2 '--format' batch shapes -o out --format nothing

# --- resume ---------------------------------------------------------------------------------------
again=("${outputs[@]}" --resume)
bad 2 'say --resume' batch shapes -o whole
batch 9 shapes -o whole "${again[@]}"
said 'done 0, failed 0; before: done 4, failed 2;'
batch 9 shapes -o parts "${again[@]}"
said 'before: done 4, failed 2;'
batch 9 shapes -o whole "${again[@]}" --retry
said 'done 0, failed 2 .*before: done 4, failed 0;'
rm whole/skeletons/shapes/torus.ply.json
batch 9 shapes -o whole "${again[@]}"
said 'done 1, failed 0; before: done 3, failed 2;'
options=(--grid 20)
batch 9 shapes -o whole "${again[@]}"
said 'done 4, failed 2'
options=(--grid 16)
batch 9 shapes -o whole "${again[@]}"
said 'done 4, failed 2'
cp shapes/capsule.obj kept.obj
cp shapes/broken.obj shapes/capsule.obj
batch 9 shapes -o whole "${again[@]}"
said 'done 0, failed 1 \(malformed 1\); before: done 3, failed 2;'
cp kept.obj shapes/capsule.obj
batch 9 shapes -o whole "${again[@]}"
said 'done 1, failed 0; before: done 3, failed 2;'
merged whole
same merged.jsonl whole.jsonl

# --- torn lines -----------------------------------------------------------------------------------
printf '{"id":"shapes/torus.ply","sta' >>whole/results-0-of-1.jsonl
batch 9 shapes -o whole "${again[@]}"
said 'torn'
merged whole
same merged.jsonl whole.jsonl
[ ! -s stderr ] || fail "the torn line stays: $(cat stderr)"

# --- manifests, also hostile ones -------------------------------------------------------------------
mkdir in
cp shapes/capsule.obj in/a.obj
cp shapes/capsule.obj 'in/a b.obj'
cp shapes/capsule.obj $'in/a\nb.obj'
cp shapes/capsule.obj ./-
long=$(printf 'x%.0s' {1..3000})
cat >in/manifest <<EOF
in/a.obj
$work/in/a.obj
in/../in/./a.obj
in/a.obj
{"path": "in/a b.obj", "id": "../../../../escape"}
{"path": "in/a.obj", "id": "/etc/escape"}
{"path": "in/a\nb.obj", "grid": 24, "largest": true}
{"path": "in/a.obj", "id": "$long"}
{"path": "in/a.obj", "id": "$long/$long/$long"}
{"path": "in/a.obj", "id": ".."}
{"path": "in/a.obj", "id": "<script>&'\u0000"}
{"path": "in/a.obj", "id": "in/a.obj~2"}
{"path": "-", "from": "obj"}

in/nothing.obj
in
EOF
printf 'in/a.obj\r\n' >>in/manifest
mkdir jail jail/cell
batch 9 --manifest in/manifest -o jail/cell/all
said 'done 14, failed 2 \(cannot-read 2\)'
rows_of jail/cell/all
for id in in/a.obj "${work#/}/in/a.obj" in/in/a.obj in/a.obj~2 in/a.obj~2~2 in/a.obj~3 escape etc/escape \
  in/a_b.obj _ - in in/nothing.obj; do
  cut -d ' ' -f 1 rows | grep -qxF -- "$id" || fail "no id $id: $(cat rows)"
done
[ "$(cut -d ' ' -f 1 rows | sort | uniq -d | wc -l)" -eq 0 ] || fail "an id twice"
[ "$(find jail/cell/all -name '*.skel' | wc -l)" -eq 14 ] || fail "skeletons are missing"
[ "$(find jail -mindepth 1 | grep -vc '^jail/cell')" -eq 0 ] || fail "outside: $(find jail)"
[ "$(find jail/cell -mindepth 1 -maxdepth 1 | wc -l)" -eq 1 ] || fail "outside: $(find jail/cell)"
grep -q '"grid":24,.*"largest":true' jail/cell/all/results*.jsonl || fail "no options of a shape"
good merge jail/cell/all -o out.html
! grep -q '<script' out.html || fail "a script in the report"
rm out.html
"$marrow" batch --manifest - -o piped "${quick[@]}" "${options[@]}" --quiet <in/manifest
good merge jail/cell/all -o all.jsonl
merged piped
same merged.jsonl all.jsonl

# refused_line LINE WORDS: a manifest with this line is refused before anything is done.
refused_line() {
  printf 'in/a.obj\n%s\n' "$1" >manifest
  bad 4 "manifest:2: " batch --manifest manifest -o out
  said "$2"
}
refused_line '{"path": 3}' '"path": is no text'
refused_line '{"path": "in/a.obj"' 'is not one JSON object'
refused_line '{"id": "a"}' 'there is no "path"'
refused_line '{"path": "a\u0000b"}' 'the path holds a zero byte'
refused_line '{"path": "a", "grid": 3}' '--grid'
refused_line '{"path": "a", "grid": {"a": 1}}' '"grid": is no text, number'
refused_line '{"path": "a", "gird": 3}' --gird
refused_line '{"path": "a", "help": true}' --help
bad 3 'nothing: cannot be read' batch --manifest nothing -o out
bad 3 'no-*.obj: cannot be read' batch 'no-*.obj' -o out
bad 2 'no shapes' batch -o out
: >manifest
bad 2 'manifest: holds no shapes' batch --manifest manifest -o out

# --- crashes, hangs, memory -----------------------------------------------------------------------
slow=("${quick[@]}" --jobs 1 --timeout 20)
mkfifo fifo.obj
{ echo fifo.obj; echo in/a.obj; } >manifest

# worker_of PID: the process of the shape that hangs, as soon as it is there.
worker_of() {
  local worker
  until worker=$(pgrep -P "$1") && [ "$(wc -w <<<"$worker")" -eq 1 ]; do
    kill -0 "$1" 2>/dev/null || return 1
    sleep 0.02
  done
  echo "$worker"
}

batch 9 --manifest manifest -o hang --timeout 1
rows_of hang
row 'fifo.obj timeout fifo.obj: took longer than the limit of 1 s; raise --timeout'
row 'in/a.obj done'

# The address sanitizer would make an exit status of the signal.
ASAN_OPTIONS=handle_segv=0 "$marrow" batch --manifest manifest -o crash "${slow[@]}" 2>stderr &
kill -SEGV "$(worker_of $!)"
wait $!
[ $? -eq 9 ] || fail "a crash does not show in the exit status"
rows_of crash
row 'fifo.obj crash fifo.obj: the worker crashed: Segmentation fault'
row 'in/a.obj done'

# Killed from outside: tried once more, then given up.
"$marrow" batch --manifest manifest -o killed "${slow[@]}" 2>stderr &
batch=$!
kill -KILL "$(worker_of $batch)"
until [ -s killed/results-0-of-1.jsonl ]; do sleep 0.02; done
kill -KILL "$(worker_of $batch)"
wait $batch
rows_of killed
row 'fifo.obj killed fifo.obj: the worker was killed, twice'
row 'in/a.obj done'

# --- Ctrl-C, and what cannot be helped --------------------------------------------------------------
{ echo in/a.obj; echo fifo.obj; echo shapes/torus.ply; } >manifest
"$marrow" batch --manifest manifest -o stopped "${slow[@]}" 2>stderr &
batch=$!
until [ -s stopped/results-0-of-1.jsonl ]; do sleep 0.02; done
worker=$(worker_of $batch)
kill -TERM $batch
bad 2 'this shard is being run' batch --manifest manifest -o stopped --resume
cat in/a.obj >fifo.obj
wait $batch
[ $? -eq 143 ] || fail "not the status of a signal"
said "stopped; to go on: .*marrow batch --manifest manifest -o stopped .*--resume$"
rows_of stopped
[ "$(wc -l <rows)" -eq 2 ] || fail "what was under way has not been ended: $(cat rows)"
row 'fifo.obj done'

# Twice: at once, and nobody stays behind.
"$marrow" batch --manifest manifest -o stopped "${slow[@]}" --resume --retry --grid 20 2>stderr &
batch=$!
until [ "$(wc -l <stopped/results-0-of-1.jsonl)" -eq 3 ]; do sleep 0.02; done
worker=$(worker_of $batch)
kill -TERM $batch
sleep 0.05
kill -TERM $batch
wait $batch
kill -0 "$worker" 2>/dev/null && fail "a worker stays behind"

# kill -9 again and again: in the end all rows once, as if nothing had been.
for i in {1..40}; do echo "{\"path\": \"shapes/torus.ply\", \"id\": \"t$i\"}"; done >manifest
batch 0 --manifest manifest -o calm
for rows in 1 5 12 20 30; do
  "$marrow" batch --manifest manifest -o wild "${quick[@]}" "${options[@]}" --resume --quiet &
  # As soon as there are so many, or it has ended all the same.
  until [ "$(cat wild/results-*.jsonl 2>/dev/null | wc -l)" -ge $rows ]; do
    kill -0 $! 2>/dev/null || break
    sleep 0.01
  done
  kill -KILL $!
  wait $! 2>/dev/null
done
batch 0 --manifest manifest -o wild --resume
said 'before: done [1-9]'
good merge calm -o calm.jsonl
merged wild
same merged.jsonl calm.jsonl
diff -r calm/skeletons wild/skeletons || fail "other skeletons after kill -9"
[ ! -e wild/.work-0-of-1 ] || fail "drafts stay"

# A disk that is soon full: whole rows, and words for the mend.
(
  failures=0
  ulimit -f 8
  run batch --manifest manifest -o full "${quick[@]}" "${options[@]}"
  [ "$status" -eq 8 ] || fail "exit status $status on a full disk"
  said '^marrow: full/results-0-of-1.jsonl: cannot be written'
  [ "$(tail -c 1 full/results-0-of-1.jsonl | wc -l)" -eq 1 ] || fail "half a row"
  exit $failures
) || fail "a full disk"
batch 0 --manifest manifest -o full --resume
merged full
same merged.jsonl calm.jsonl

# Memory: the sanitizer's shadow is larger than any.
if ! grep -q __asan_init "$marrow"; then
  truncate -s 400M big.ply
  batch 9 big.ply in/a.obj -o memory --max-rss 64
  rows_of memory
  row 'big.ply limit big.ply: .*memory'
  row 'in/a.obj done'
fi

finish "batches are as they should be"
