#!/usr/bin/env bash
# What the documents promise and no compiler checks: the C++ in README.md is the marked part of a program
# that is built and run (test `embed`), less its indentation; and every file they link or show is there.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
program=$root/demos/embed/hello_limber.cpp
failures=0

fail() {
  printf 'FAILED: %s\n' "$1"
  failures=$((failures + 1))
}

marked=$(sed -n '/^  \/\/ readme begin$/,/^  \/\/ readme end$/p' "$program" |
  sed -e '1d' -e '$d' -e 's/^  //')
# shellcheck disable=SC2016 # backquotes of Markdown
shown=$(sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | sed -e '1d' -e '$d')
[ -n "$marked" ] || fail "hello_limber.cpp has no part between 'readme begin' and 'readme end'"
if [ "$marked" != "$shown" ]; then
  fail "the C++ in README.md (<) is not the marked part of hello_limber.cpp (>)"
  diff <(printf '%s\n' "$shown") <(printf '%s\n' "$marked")
fi

for page in "$root"/*.md "$root"/docs/*.md; do
  while read -r target; do
    [ -e "$(dirname "$page")/$target" ] || fail "${page#"$root/"} links $target, which is missing"
  done < <(grep -oE '\]\([^)#]+' "$page" | sed 's/^](//' | grep -vE '^https?:')
done

[ "$failures" -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
