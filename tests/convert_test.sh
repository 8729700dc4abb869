#!/usr/bin/env bash
# Converts skeletons between all formats, and has other programs read them where they are installed.
#
#   tests/convert_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

exact=(skel obj ply json cg graph vtp graphml csv)

# Two cycles at one joint with a tail, a part of its own and a node alone.
cat >graph.skel <<'END'
ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST
9
0 0 0 0 0.5 4 1 2 3 4 
1 1 0 0 0.25 2 0 2 
2 1 1 0 0.25 2 0 1 
3 -1 0 0 0.125 2 0 4 
4 -1 -1 0 0.1 3 0 3 5 
5 -2 -2 1e-30 0.1 1 4 
6 5 5 5 3 1 7 
7 6 5 5 2 1 6 
8 0.1 0.2 0.30000000000000004 1 0 
END

# --- there and back -------------------------------------------------------------------------------
good info graph.skel
says '^components +3'
says '^cycles +2'
sed 1d stdout >facts
mv graph.skel first.skel
for format in "${exact[@]}"; do
  good convert first.skel "graph.$format"
  [ ! -s stderr ] || fail "words about a $format: $(cat stderr)"
done
same first.skel graph.skel
for format in "${exact[@]}"; do
  good info "graph.$format"
  sed 1d stdout | cmp -s - facts || fail "other facts in a $format"
  for other in "${exact[@]}"; do
    good convert "graph.$format" "again.$other"
    same "graph.$other" "again.$other"
  done
done
good convert graph.skel graph.swc
good convert graph.swc again.swc
same graph.swc again.swc
good info graph.swc
says '^cycles +2'
grep -q '^# loop-edge' graph.swc || fail "no loops in the SWC"
good convert graph.skel graph.polylines.txt
good convert graph.polylines.txt thin.skel --radius 0.5
good info thin.skel
says '^cycles +2'
says '^components +3'
"$marrow" convert - - --from skel --to vtp <graph.skel | cmp -s - graph.vtp || fail "pipe"
cp graph.vtp odd.name
good convert odd.name odd.too --from vtp --to skel
same graph.skel odd.too

printf 'id,x,y,z,radius,section_radius,neighbours\n0,0,0,0,1,2,1\n1,1,0,0,1,0,0\n' >wide.csv
for format in ply json vtp graphml csv; do
  good convert wide.csv "wide.$format.$format"
  good info "wide.$format.$format"
  says '^section radius +2 to 2'
done
good convert wide.csv wide.skel
good info wide.skel
grep -q section stdout && fail "section radii in a .skel"

# --- other outputs --------------------------------------------------------------------------------
good convert graph.skel graph.swc --swc-split
for i in 1 2 3; do
  good info "graph-$i.swc"
  says '^components +1'
done
[ ! -e graph-4.swc ] || fail "a fourth part"
for format in obj ply stl off; do
  good convert graph.skel "tubes.$format" --capsules
  good info "tubes.$format"
  says '^kind +shape'
  says '^triangles +1140'
done
good convert graph.skel graph.glb
good convert graph.skel tubes.glb --capsules
good convert graph.skel graph.dot
good make torus -o torus.obj --resolution 0.5
for format in "${exact[@]}" swc dot glb polylines.txt; do
  good extract torus.obj -o "torus.skeleton.$format" --image 96 --grid 32 --quiet
  case $format in dot | glb | polylines.txt) continue ;; esac
  good info "torus.skeleton.$format"
  says '^cycles +1'
  good render torus.obj "torus.skeleton.$format" -o "torus.$format.png" --size 160x120
  same torus.skel.png "torus.$format.png"
done

# --- edits ----------------------------------------------------------------------------------------
good convert graph.skel even.skel --spacing 0.1
good info even.skel --json
says '"cycles": 2'
good convert even.skel plain.skel --simplify 0.05
good compare graph.skel plain.skel --json
says '"same_topology": true'
good convert graph.skel fine.skel --spacing-by-radius 0.5
good compare graph.skel fine.skel
says '^same topology'
says '^hausdorff +[0-9.e-]+ \([0-9.e-]+ %\)'
good convert graph.skel pruned.skel --prune-length 2
good compare graph.skel pruned.skel
says '^leaves +3 +2 +-1'
says '^other topology'
good convert graph.skel pruned.skel --prune-radius 0.2
good info pruned.skel
says '^leaves +2'
good convert graph.skel part.skel --largest
good info part.skel
says '^components +1'
good convert graph.skel part.skel --min-part 50
good info part.skel
says '^components +2'
good compare graph.polylines.txt graph.skel
says '^hausdorff +(0|[0-9.]+e-1[0-9]) '
"$marrow" compare graph.skel - --from vtp <graph.vtp | grep -q '^same topology' || fail "compare in a pipe"
printf 'n 0 0 0 1\n' >one.graph
good compare one.graph one.graph
says '^mean +0 +0 +0'

# --- refusals -------------------------------------------------------------------------------------
echo broken >broken.skel
touch empty.graph
bad 2 'OUT is required' convert graph.skel
bad 2 'is the input' convert graph.skel graph.skel
bad 2 '--from' convert - out.skel
bad 2 '--to' convert graph.skel -
bad 2 '--radius' convert graph.skel out.skel --radius 0
bad 2 'swc-split' convert graph.skel out.skel --swc-split
bad 2 'is the input' convert graph-1.swc graph.swc --swc-split
bad 2 'swc-split' convert graph.skel out.swc --swc-split --capsules
bad 2 '--spacing' convert graph.skel out.skel --spacing -1
bad 2 '--simplify' convert graph.skel out.skel --spacing 1 --simplify 1
bad 7 'raise it' convert graph.skel out.skel --spacing 1e-12
bad 2 'standard input' compare - - --from skel
bad 2 'B is required' compare graph.skel
bad 4 'broken' compare broken.skel graph.skel
bad 5 '--from' compare odd.name graph.skel
bad 6 'without nodes' compare empty.graph graph.skel
bad 3 'none.skel' convert none.skel out.obj
bad 4 'convert --radius' convert graph.polylines.txt out.skel
bad 4 'graph.vtp:1' convert graph.vtp out.skel --from skel
bad 5 'only written' convert graph.dot out.skel
bad 5 '--from' convert odd.name out.skel
bad 5 'out.png' convert graph.skel out.png
bad 8 'no folder' convert graph.skel none/out.skel
printf '# D:3 NV:1 NE:0\nv 0 0 0\n# radius 1 1e39\n' >far.cg
bad 5 'beyond' convert far.cg out.glb

# --- other programs read them ---------------------------------------------------------------------
readers=()
# reader NAME COMMAND...: whether that program is there.
reader() {
  if "${@:2}" >/dev/null 2>&1; then
    readers+=("$1")
  else
    echo "skipped: no $1 on this machine"
    return 1
  fi
}

if reader networkx /usr/bin/python3 -c 'import networkx'; then
  /usr/bin/python3 - >stdout 2>&1 <<'END' || fail "networkx: $(cat stdout)"
import networkx
g = networkx.read_graphml("graph.graphml")
assert len(g) == 9 and g.number_of_edges() == 8, g
assert networkx.number_connected_components(g) == 3
assert len(networkx.cycle_basis(g)) == 2
assert g.nodes["8"] == {"x": 0.1, "y": 0.2, "z": 0.30000000000000004, "radius": 1.0}
assert g.edges["4", "5"]["length"] == 2 ** 0.5
assert g.edges["0", "1"]["branch"] == g.edges["1", "2"]["branch"] != g.edges["4", "5"]["branch"]
networkx.write_graphml(g, "theirs.graphml")
END
  good convert theirs.graphml again.skel
  same graph.skel again.skel
fi
if reader VTK /usr/bin/python3 -c 'import vtk'; then
  /usr/bin/python3 - >stdout 2>&1 <<'END' || fail "VTK: $(cat stdout)"
import vtk
reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName("graph.vtp")
reader.Update()
data = reader.GetOutput()
assert data.GetNumberOfPoints() == 9 and data.GetNumberOfVerts() == 1, data
radii = data.GetPointData().GetScalars()
assert radii.GetName() == "MaximumInscribedSphereRadius" and radii.GetValue(0) == 0.5
assert data.GetCellData().GetArray("BranchId").GetValue(0) == -1
lines = vtk.vtkOBJReader()
lines.SetFileName("graph.obj")
lines.Update()
lines = lines.GetOutput()
assert lines.GetNumberOfPoints() == 9 and lines.GetNumberOfLines() == 8, lines
writer = vtk.vtkXMLPolyDataWriter()
writer.SetDataModeToAscii()
writer.SetInputData(data)
writer.SetFileName("theirs.vtp")
writer.Write()
END
  good convert theirs.vtp again.skel
  same graph.skel again.skel
fi
if reader graphviz dot -V; then
  dot -Tplain graph.dot >stdout 2>stderr || fail "dot: $(cat stderr)"
  [ ! -s stderr ] || fail "dot warns: $(cat stderr)"
  [ "$(grep -c '^node' stdout)" -eq 9 ] || fail "dot: not nine nodes"
  [ "$(grep -c '^edge' stdout)" -eq 8 ] || fail "dot: not eight edges"
fi
if reader assimp assimp version; then
  for file in tubes.obj tubes.ply tubes.stl tubes.glb graph.glb; do
    assimp info "$file" >stdout 2>&1 || fail "assimp: $file: $(tail -n 1 stdout)"
    grep -q '^Faces: *[1-9]' stdout || fail "assimp: nothing in $file"
  done
fi

finish "skeletons go from format to format; read by: ${readers[*]:-no other program}"
