#!/usr/bin/env bash
# Pages of `marrow view` as the shell gets them, and what is refused. tests/view_browser_test.py opens
# them.
#
#   tests/view_command_test.sh MARROW
source "$(dirname "${BASH_SOURCE[0]}")/cli_lib.sh"

quick=(--image 96 --grid 32 --quiet)

good make star -o star.obj --resolution 0.5
good extract star.obj -o star.skel --trace stages "${quick[@]}"
good view star.obj star.skel -o star.html
if [ -s stdout ] || [ -s stderr ]; then fail "view says something"; fi
grep -q '<title>star.obj</title>' star.html || fail "no title"
good view star.obj star.skel -o -
same star.html stdout
cp star.obj piped.obj
"$marrow" view - star.skel --from obj --title star.obj -o piped.html <piped.obj || fail "no pipe"
same star.html piped.html
good view star.obj star.skel -o stages.html --trace stages
for stage in tree core thinned collapsed smoothed; do
  grep -q "\"name\":\"$stage\"" stages.html || fail "no layer $stage"
done
good view star.obj star.skel -o named.htm --title '<b>&</b>'
grep -q '<title>&lt;b&gt;&amp;&lt;/b&gt;</title>' named.htm || fail "words of a title are HTML"

good make star -o star.nrrd --voxels 48
good view star.nrrd star.skel -o volume.html
sed -n 's/^v //p' star.obj >cloud.xyz
good view cloud.xyz star.skel -o cloud.html
good make plant -o large.ply --resolution 3
good view large.ply star.skel -o large.html
[ "$(wc -c <large.html)" -lt 2000000 ] || fail "a page of $(wc -c <large.html) bytes"

mkdir empty
bad 5 'pages are .html files' view star.obj star.skel -o out.png
bad 2 'only one of' view - - -o out.html --from obj
bad 3 'none.skel' view star.obj none.skel -o out.html
bad 3 'none: cannot be read' view star.obj star.skel -o out.html --trace none
bad 6 'no graph of a stage' view star.obj star.skel -o out.html --trace empty
bad 4 'star.obj' view star.obj star.obj -o out.html
bad 8 'no folder' view star.obj star.skel -o none/out.html
printf 'v 1 2\n' >broken.obj
bad 4 'broken.obj' view broken.obj star.skel -o out.html

finish "pages: all good"
