#!/usr/bin/env bash
# What the documents promise and no compiler checks: every piece of C++ in README.md and docs/ stands, less its
# indentation, in a program or a test that is built and run; every file they link or show is there.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
failures=0
blocks=0

fail() {
  printf 'FAILED: %s\n' "$1"
  failures=$((failures + 1))
}

unindented() { sed -e 's/^ *//' -e 's/ *$//' "$@"; }

programs=()
while IFS= read -r file; do
  programs+=("$(unindented "$file")")
done < <(find "$root/demos/embed" "$root/tests" -name '*.cpp' | sort)

check_block() {  # PAGE BLOCK
  local program
  blocks=$((blocks + 1))
  for program in "${programs[@]}"; do
    [[ $program == *"$2"* ]] && return
  done
  fail "${1#"$root/"}: no program or test contains the C++ that begins with '${2%%$'\n'*}'"
}

# shellcheck disable=SC2016 # backquotes of Markdown
for page in "$root"/*.md "$root"/docs/*.md; do
  block=
  while IFS= read -r line; do
    case $line in
      '```cpp') block=$'\n' ;;
      '```') [ -n "$block" ] && check_block "$page" "${block:1:-1}"; block= ;;
      *) [ -n "$block" ] && block+=$line$'\n' ;;
    esac
  done < <(unindented "$page")
  while read -r target; do
    [ -e "$(dirname "$page")/$target" ] || fail "${page#"$root/"} links $target, which is missing"
  done < <(sed '/^```/,/^```/d' "$page" | grep -oE '\]\([^)#]+' | sed 's/^](//' | grep -vE '^https?:')
done

[ "$blocks" -ge 2 ] || fail "found $blocks pieces of C++ in the documents: is this still the right pattern?"
[ "$failures" -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
