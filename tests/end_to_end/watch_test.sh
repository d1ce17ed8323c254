#!/usr/bin/env bash
# `limber run --watch` as a user has it: saves, mistakes, a module, Ctrl-C. Usage: watch_test.sh LIMBER
set -u
limber=$1
scratch=$(mktemp -d)
trap '[ -n "${watching-}" ] && kill "$watching" 2>/dev/null; rm -rf "$scratch"' EXIT
scene=$scratch/scene.lua said=$scratch/said printed=$scratch/printed json=$scratch/run.json
failures=0

fail() {
  printf 'FAILED: %s\nit said:\n%s\n' "$1" "$(cat "$said")"
  failures=$((failures + 1))
}

# says TEXT WHAT: waits until the program has said this on standard error, for 20 s at most.
says() {
  local tries=0
  until grep -qF -- "$1" "$said"; do
    tries=$((tries + 1))
    if [ $tries -gt 200 ]; then
      fail "$2"
      return
    fi
    sleep 0.1
  done
}

# waits N: until it has waited for a change for the N-th time.
waits() {
  local tries=0
  until [ "$(grep -cF 'waiting for a change' "$said")" -ge "$1" ]; do
    tries=$((tries + 1))
    if [ $tries -gt 200 ]; then
      fail "waits for the $1. time"
      return
    fi
    sleep 0.1
  done
}

# save FILE TEXT: as editors do, by a new file in the place of the old one.
save() {
  printf '%s\n' "$2" >"$1.new"
  mv "$1.new" "$1"
}

save "$scene" 'scene{seconds = 0.1} print("first run")'
"$limber" run --watch "$scene" --json "$json" >"$printed" 2>"$said" &
watching=$!
says 'first run' 'it runs at once'
waits 1
grep -qF 'scene' "$printed" || fail 'the first run is reported'
[ -s "$json" ] || fail 'the first run is written as JSON'

save "$scene" 'scene{seconds = 0.1} rigid.sphere{raduis = 1}'
says "did you mean 'radius'" 'a mistake is said'
waits 2
kill -0 "$watching" 2>/dev/null || fail 'a mistake does not end it'

save "$scene" 'scene{seconds = 0.1} function on_tick() error("in the middle") end'
says 'in the middle' 'an error while the scene runs is said'
waits 3
kill -0 "$watching" 2>/dev/null || fail 'an error while the scene runs does not end it'

save "$scene" 'scene{seconds = 0.1} print(require("part").text)'
says 'there is no such file' 'a missing module is said'
waits 4
save "$scratch/part.lua" 'return {text = "module once"}'
says 'module once' 'the module that was missing is seen'
waits 5
save "$scratch/part.lua" 'return {text = "module twice"}'
says 'module twice' 'a module that is saved starts it again'
waits 6

# A scene that would run for minutes (a falling ball alone does 1e4 s in one) starts again in the
# middle.
long='scene{seconds = 1e4} rigid.sphere{radius = 1, mass = 1, position = {0, 9, 0}}
function on_tick() for i = 1, 20000 do local x = i * i end end
'
save "$scene" "$long print('a long one')"
says 'a long one' 'a long scene starts'
save "$scene" "$long print('another one')"
says 'another one' 'a scene that is saved while it runs starts again'

# While nothing changes it does nothing: two seconds cost less than a fifth of one.
save "$scene" 'scene{seconds = 0.1} print("idle now")'
says 'idle now' 'a short one again'
waits 7
ticks() { awk '{print $14 + $15}' "/proc/$watching/stat"; } # of the processor, 10 ms each
if [ -r "/proc/$watching/stat" ]; then
  before=$(ticks)
  sleep 2
  used=$(($(ticks) - before))
  [ "$used" -lt 20 ] || fail "waiting costs $used ticks of 10 ms in 2 s"
fi

# Ctrl-C in the middle of a run: it ends with what it recorded.
save "$scene" "$long print('the last one')"
says 'the last one' 'a long one again'
sleep 0.5
rm "$json"
kill -INT "$watching"
wait "$watching"
status=$?
watching=
[ $status -eq 0 ] || fail "Ctrl-C ends it with 0, not $status"
seconds=$(grep -o '"seconds": *[0-9.e+-]*' "$json" | head -n 1 | grep -o '[0-9.e+-]*$')
awk "BEGIN { exit !(${seconds:-0} > 0 && ${seconds:-0} < 1e4) }" ||
  fail "what ran until Ctrl-C is written: ${seconds:-nothing} s"

"$limber" run --watch "$scratch/none.lua" 2>"$said" >"$printed"
[ $? -eq 2 ] || fail 'a file that is not there is refused'
grep -qF 'there is no file' "$said" || fail 'and said'

[ "$failures" -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
