#!/usr/bin/env bash
# Format, names and common slips of all C++ sources and scripts; needs scripts/setup.sh --dev.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

say "clang-format"
git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run --Werror

say "links in the documents"
for page in README.md CHANGELOG.md docs/*.md; do
  links=$(grep -oE '\]\([^):]+\)' "$page" | tr -d '])(') || continue  # no colon: none of the web
  for link in $links; do
    [ -e "$(dirname "$page")/${link%%#*}" ] || die "$page: there is no $link"
  done
done

say "shellcheck"
git ls-files -z '*.sh' .ci/run | xargs -0 shellcheck --external-sources --source-path=SCRIPTDIR

say "pyflakes"
git ls-files -z apps bench tests |
  xargs -0 grep -lZ -E '^(#!/usr/bin/python3|""")' |
  xargs -0 /usr/bin/python3 -m pyflakes

say "clang-tidy"
quietly build/release.configure.log cmake --preset release
# Warnings are the compiler's matter: clang finds others than the GCC that the flags are for.
# bench/peers is a project of its own.
git ls-files -z '*.cpp' ':!bench/peers' |
  xargs -0 -n 1 -P "$jobs" clang-tidy -p build/release --quiet --extra-arg=-Wno-error \
    2>build/clang-tidy.log ||
  die "clang-tidy found what is above (to repeat it on one file: clang-tidy -p build/release FILE)"
