#!/usr/bin/env bash
# The C++ in README.md is the marked part of a program that is compiled and run (test `embed`), less
# its indentation; and the files that README.md shows or links exist.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
program=$root/demos/embed/hello_limber.cpp
failures=0

fail() {
  printf 'FAILED: %s\n' "$1"
  failures=$((failures + 1))
}

marked=$(sed -n '/readme begin/,/readme end/p' "$program" | sed -e '1d' -e '$d' -e 's/^  //')
shown=$(sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | sed -e '1d' -e '$d')
[ -n "$marked" ] || fail "$program has no part between 'readme begin' and 'readme end'"
if [ "$marked" != "$shown" ]; then
  fail "the C++ in README.md is not the marked part of $program:"
  diff <(printf '%s\n' "$shown") <(printf '%s\n' "$marked")
fi

for page in README.md CHANGELOG.md docs/*.md; do
  [ "$page" = 'docs/*.md' ] && continue
  :
done

[ "$failures" -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
