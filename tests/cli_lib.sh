# shellcheck shell=bash
# What the tests of the program share; sourced with MARROW, never run. Sets `marrow` and `work`, a
# folder that is removed at the end and that the test is in.

set -uo pipefail
marrow=$(realpath "$1")
[ -x "$marrow" ] || exit 1
work=$(mktemp -d "${TMPDIR:-/tmp}/marrow-test.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

failures=0
fail() {
  printf 'FAIL line %s: %s\n' "${BASH_LINENO[-2]}" "$*"
  failures=$((failures + 1))
}

# run ARGUMENT...: keeps exit status, standard output and standard error.
run() {
  "$marrow" "$@" >stdout 2>stderr </dev/null
  status=$?
}

# good ARGUMENT...: must succeed.
good() {
  run "$@"
  [ "$status" -eq 0 ] || fail "marrow $*: exit status $status: $(cat stderr)"
}

# left_behind WHAT: a file called out* or a temporary one is a failure, and goes.
left_behind() {
  local files
  files=$(find . -name 'out*' -o -name '*.tmp' -o -name '.marrow-*')
  [ -n "$files" ] || return 0
  fail "$1: left behind: $files"
  xargs rm -rf <<<"$files"
}

# refused STATUS WORDS WHAT: the last run must have failed with this status, in one line with these
# words on standard error, and leave nothing behind.
refused() {
  [ "$status" -eq "$1" ] || fail "$3: exit status $status instead of $1: $(cat stderr)"
  [ "$(wc -l <stderr)" -eq 1 ] || fail "$3: not one line: $(cat stderr)"
  grep -q '^marrow: ' stderr || fail "$3: not in the name of marrow: $(cat stderr)"
  grep -qF -- "$2" stderr || fail "$3: no word about '$2': $(cat stderr)"
  left_behind "$3"
}

# bad STATUS WORDS ARGUMENT...: must be refused like this, without data on standard output.
bad() {
  local expected=$1 words=$2
  shift 2
  run "$@"
  [ ! -s stdout ] || fail "marrow $*: data on standard output"
  refused "$expected" "$words" "marrow $*"
}

# says WORDS: the last run's standard output has a line with these words.
says() {
  grep -qE -- "$1" stdout || fail "nothing says '$1': $(cat stdout)"
}

same() {
  cmp -s "$1" "$2" || fail "$1 and $2 differ"
}

# finish WORDS: the end of a test, with these words if nothing has failed.
finish() {
  [ "$failures" -eq 0 ] || exit 1
  echo "$1"
}
