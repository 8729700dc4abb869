#!/usr/bin/env bash
# The C++ reference is made without a warning, in build/docs/html, and no page links to a file that is
# not there.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

say "links"
broken=0
while IFS= read -r page; do
  while IFS= read -r target; do
    [ -e "$(dirname "$page")/$target" ] || [ -e "$target" ] || {
      echo "$page links to $target, which is not there"
      broken=1
    }
  done < <(grep -oE '\]\([^)#: ]+[)#]' "$page" | sed 's/^](//; s/.$//')
done < <(git ls-files '*.md')
[ "$broken" -eq 0 ] || die "mend these links"

say "reference"
command -v doxygen >/dev/null || die "doxygen is missing; scripts/setup.sh --dev installs it"
mkdir -p build
quietly build/docs.log doxygen docs/Doxyfile
echo "build/docs/html/index.html"
