#!/usr/bin/env bash
# The two commands' own promises that can be checked without a build: usage errors, help, dependencies.txt.
set -u
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
failures=0

# expect WHAT COMMAND...: counts and names a check that does not hold.
expect() {
  local what=$1
  shift
  "$@" || { printf 'FAILED: %s\n' "$what"; failures=$((failures + 1)); }
}

# run COMMAND...: sets status, out and err.
run() {
  local err_file
  err_file=$(mktemp)
  out=$("$@" 2>"$err_file" </dev/null)
  status=$?
  err=$(<"$err_file")
  rm -f "$err_file"
}

# shellcheck disable=SC2317 # called by expect
one_line_by() { [[ $err == "$1: "*"; "* && $err != *$'\n'* ]]; }

cd / || exit 1 # the commands must not care where they are called from
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for command in quickstart check; do
  for argument in --bogus fast ""; do
    run "$root/$command" "$argument"
    expect "$command '$argument' exits with 2, not $status" test "$status" -eq 2
    expect "$command '$argument' says WHAT; REMEDY in one line: $err" one_line_by "$command"
    expect "$command '$argument' prints nothing on standard output: $out" test -z "$out"
  done

  run "$root/$command" --bogus --help
  expect "$command refuses an unknown argument even before --help" test "$status" -eq 2

  run "$root/$command" --help
  expect "$command --help exits with 0, not $status" test "$status" -eq 0
  expect "$command --help prints its usage" test "${out#"usage: ./$command "}" != "$out"
  expect "$command --help prints nothing on standard error: $err" test -z "$err"

  ln -s "$root/$command" "$scratch/$command"
  run "$scratch/$command" --help
  expect "$command works through a symbolic link" test "$status" -eq 0
done

packages=$(sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$root/dependencies.txt")
expect "dependencies.txt names packages" test -n "$packages"
expect "dependencies.txt holds only package names" test -z "$(grep -vxE '[a-z0-9][a-z0-9+.-]+' <<<"$packages")"
expect "dependencies.txt holds no package twice" test -z "$(sort <<<"$packages" | uniq -d)"
expect "dependencies.txt says of every package what for" \
  test -z "$(grep -vE '^$|^#|^[^ ]+ +# .' "$root/dependencies.txt")"
if command -v dpkg-query >/dev/null; then
  for package in $packages; do
    expect "dependencies.txt: $package is known to dpkg" dpkg-query -W "$package" >"$scratch/known"
  done
fi

[ "$failures" -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
