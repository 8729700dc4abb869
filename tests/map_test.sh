#!/usr/bin/env bash
# Surface maps as the program writes them: of meshes, clouds and volumes, and what is refused.
#
#   tests/map_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

quick=(--image 96 --grid 32 --quiet)

good make star -o star.obj --truth star.skel --resolution 0.5
good extract star.obj -o lines.obj --map map.csv "${quick[@]}"
points=$(grep -c '^v ' star.obj)
[ "$(head -1 map.csv)" = point,node,branch,part ] || fail "no names: $(head -1 map.csv)"
[ "$(tail -n +2 map.csv | wc -l)" -eq "$points" ] || fail "not a line to a point"

# --- extract and map give the same ----------------------------------------------------------------
for format in csv json ply; do
  good extract star.obj -o lines.obj --map "map.$format" "${quick[@]}"
  good map star.obj lines.obj -o "again.$format"
  same "map.$format" "again.$format"
  good map star.obj lines.obj -o - --to "$format"
  same "map.$format" stdout
done
"$marrow" map - lines.obj --from obj -o piped.csv <star.obj || fail "no map from a pipe"
same map.csv piped.csv

# --- each of them is what its format says ---------------------------------------------------------
good info map.ply
says "^points +$points$"
says '^kind +shape$'
good map star.obj star.skel -o truth.json
python3 - "$points" <<'EOF' || fail "the JSON is not what it says"
import json, sys
m = json.load(open("truth.json"))
assert m["format"] == "marrow-map" and m["version"] == 1 and m["of"] == "points" and m["parts"] == 1
assert len(m["node"]) == len(m["branch"]) == len(m["part"]) == int(sys.argv[1])
assert len(m["branches"]) == 6 and set(m["branch"]) == set(range(6))
assert all(n in m["branches"][b] for n, b in zip(m["node"], m["branch"]))
EOF

# --- rigs -----------------------------------------------------------------------------------------
good map star.obj star.skel -o rig.glb
joints=$(sed -n 2p star.skel)
if assimp version >/dev/null 2>&1; then
  assimp info rig.glb >stdout 2>&1 || fail "assimp: $(tail -n 1 stdout)"
  says '^Bones: +[1-9]'
  [ "$(grep -c 'joint [0-9]' stdout)" -eq "$joints" ] || fail "assimp: not $joints joints"
  says '^Faces: +[1-9]'
else
  echo "skipped: no assimp on this machine"
fi

# --- clouds and volumes ---------------------------------------------------------------------------
sed -n 's/^v //p' star.obj >cloud.xyz
good map cloud.xyz star.skel -o cloud.ply
good info cloud.ply
says '^kind +points$'
good make star -o star.nrrd --voxels 48
good map star.nrrd star.skel -o voxels.csv
[ "$(head -1 voxels.csv)" = x,y,z,node,branch,part ] || fail "no names: $(head -1 voxels.csv)"
good info star.nrrd --json
grep -q "\"foreground\": $(tail -n +2 voxels.csv | wc -l)," stdout || fail "not a line to a voxel"
good map star.nrrd star.skel -o voxels.json
python3 -c 'import json
m = json.load(open("voxels.json"))
assert m["of"] == "voxels" and len(m["index"]) == len(m["node"])
assert max(m["index"]) < m["voxels"][0] * m["voxels"][1] * m["voxels"][2]' || fail "voxels"

# --- what is refused ------------------------------------------------------------------------------
printf '{"format": "marrow-skeleton", "version": 1, "nodes": [], "edges": []}' >none.json
bad 6 'none.json: the skeleton has no nodes' map star.obj none.json -o out.csv
bad 5 'out.txt: maps are' map star.obj star.skel -o out.txt
bad 5 'out.txt: maps are' extract star.obj -o out.obj --map out.txt "${quick[@]}"
bad 2 'a file with an extension' map star.obj star.skel -o -
bad 2 'only one of' map - - -o out.csv --from obj
bad 2 'twice' extract star.obj -o out.ply --map out.ply "${quick[@]}"
bad 2 'is the input' map star.obj star.skel -o star.obj --to ply
bad 5 'a .glb is of a mesh' map star.nrrd star.skel -o out.glb
bad 6 'no skin' map cloud.xyz star.skel -o out.glb
bad 3 'none.obj' map none.obj star.skel -o out.csv
bad 8 'no folder' map star.obj star.skel -o none/out.csv

finish "maps: all good"
