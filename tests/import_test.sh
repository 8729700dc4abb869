#!/usr/bin/env bash
# Meshes of other ecosystems: what marrow-import reads, and what its death looks like.
#
#   tests/import_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

importer=$(dirname "$marrow")/marrow-import

# info_says FILE WORDS: marrow info has a line with these words.
info_says() {
  good info "$1"
  says "$2"
}

# --- a box of 1 by 1 by 1: eight points in floats, twelve triangles in 16 bits -----------------------
zero='\0\0\0\0' one='\0\0\x80\x3f'
for corner in "$zero$zero$zero" "$one$zero$zero" "$zero$one$zero" "$one$one$zero" \
  "$zero$zero$one" "$one$zero$one" "$zero$one$one" "$one$one$one"; do
  printf '%b' "$corner"
done >buffer.bin
for corner in 0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 3 5 3 7 5; do
  printf '%b\0' "\x0$corner"
done >>buffer.bin
size=$(stat -c %s buffer.bin)

# gltf URI: the box twice, one four times as long, the other put beside it; through two nodes each.
gltf() {
  cat <<END
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"translation": [10, 0, 0], "children": [1, 2]},
           {"mesh": 0, "scale": [4, 1, 1]}, {"mesh": 0, "translation": [0, 0, 5]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "buffers": [{"byteLength": $size$1}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                 {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 1]},
               {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}]}
END
}

# little NUMBER: four bytes, the lowest first.
little() {
  local n=$1
  printf '%b' "$(printf '\\x%02x' $((n & 255)) $((n >> 8 & 255)) $((n >> 16 & 255)) $((n >> 24)))"
}

# glb LIE: the same in one binary file, whose header tells of LIE more bytes.
glb() {
  local json
  json=$(gltf '' | tr -d '\n')
  while [ $((${#json} % 4)) -ne 0 ]; do json+=' '; done
  printf 'glTF'
  little 2
  little $((12 + 8 + ${#json} + 8 + size + $1))
  little ${#json}
  printf 'JSON%s' "$json"
  little "$size"
  printf 'BIN\0'
  cat buffer.bin
}

gltf ", \"uri\": \"data:application/octet-stream;base64,$(base64 -w0 buffer.bin)\"" >box.gltf
gltf ', "uri": "buffer.bin"' >apart.gltf   # which is there
glb 0 >box.glb
glb 1000 >lie.glb
head -c 300 box.glb >cut.glb
head -c 400 box.gltf >cut.gltf
printf '%200000s' '' | tr ' ' '[' >deep.gltf
touch empty.fbx
echo '{}' >none.gltf
for format in fbx dae 3ds x3d 3mf; do head -c 3000 /dev/urandom >"garbage.$format"; done
cp box.glb box.bytes

# --- where there is no importer, or one that dies ---------------------------------------------------
mkdir alone
cp "$marrow" alone/marrow
with=$marrow
marrow=$PWD/alone/marrow
bad 5 'box.glb: is read by marrow-import, which is not beside marrow' info box.glb

# stands_in WORDS...: a script in place of the importer.
stands_in() {
  printf '#!/bin/sh\n%s\n' "$*" >alone/marrow-import
  chmod +x alone/marrow-import
}
for death in 'kill -SEGV $$' 'kill -ABRT $$' 'exit 1' 'exit 4' 'echo words >&2; exit 77'; do
  stands_in "$death"
  bad 4 'box.glb: cannot be read: the importer crashed; convert it to PLY or OBJ' \
    extract box.glb -o out.obj
done
stands_in 'kill -KILL $$'
bad 7 'box.glb: takes the importer more time or memory' info box.glb
stands_in 'echo it is broken >&2; echo more >&2; exit 4'
bad 4 'box.glb: it is broken' info box.glb
stands_in 'exit 0'
bad 6 'box.glb' info box.glb
stands_in 'echo ply'
bad 4 'box.glb' info box.glb
stands_in 'exec sleep 20'
bad 7 'box.glb: took longer than the limit of 1 s' info box.glb --timeout 1
marrow=$with

if [ ! -x "$importer" ]; then
  [ "$failures" -eq 0 ] || exit 1
  echo "skipped: reading glTF and others, because there was no Assimp when marrow was built"
  exit 0
fi

# --- what is read -----------------------------------------------------------------------------------
for file in box.gltf box.glb; do
  info_says "$file" '^triangles +24$'
  info_says "$file" '^components +2$'
  info_says "$file" '^closed +yes$'
  info_says "$file" '^bounds +10 0 0 to 14 1 6$'
done
"$marrow" info - --from glb <box.bytes >stdout || fail "standard input"
for format in gltf glb; do
  "$marrow" extract "box.$format" -o "$format.obj" --quiet || fail "extract box.$format"
done
cmp -s gltf.obj glb.obj || fail "gltf and glb give two skeletons"
"$marrow" info gltf.obj | grep -qE '^components +2$' || fail "not two parts: $("$marrow" info gltf.obj)"
"$marrow" render box.glb glb.obj -o box.png --size 320x240 || fail "render"

# --- what is not ------------------------------------------------------------------------------------
bad 5 'apart.gltf: needs another file' extract apart.gltf -o out.obj
bad 4 'lie.glb: has ' extract lie.glb -o out.obj
bad 4 'cut.glb: has 300 bytes' extract cut.glb -o out.obj
bad 4 'cut.gltf: cannot be read' extract cut.gltf -o out.obj
bad 4 'deep.gltf: cannot be read' extract deep.gltf -o out.obj
bad 6 'empty.fbx: is empty' extract empty.fbx -o out.obj
bad 7 'box.glb: holds more triangles than the limit of 23; raise --max-faces' \
  extract box.glb -o out.obj --max-faces 23
for file in none.gltf garbage.*; do
  "$marrow" extract "$file" -o out.obj >stdout 2>stderr
  case $? in 4 | 6) ;; *) fail "$file: $(cat stderr)" ;; esac
  [ "$(wc -l <stderr)" -eq 1 ] || fail "$file: not one line: $(cat stderr)"
done

finish "what the importer reads is a shape, and what kills it is one line"
