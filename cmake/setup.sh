# shellcheck shell=bash
# What ./quickstart and ./check share: packages, configuration, build. Sourced by both, after they set
# `me` (their name, for messages) and `root` (the repository). Every step is safe to repeat.
: "${me:?}" "${root:?}"

preset=release
build_dir="build/$preset"
packages_file=dependencies.txt
logs=build/logs

# The room that a build of everything needs, and the room that a finished one needs to be brought up to date.
room_first_mib=300
room_again_mib=50

say() { printf 'limber: %s\n' "$*"; }

# fail STATUS "WHAT; REMEDY": 2 for bad usage and missing prerequisites, 1 for what went wrong on the way.
fail() {
  printf '%s: %s\n' "$me" "$2" >&2
  exit "$1"
}

# fail_with_log LOG "WHAT; REMEDY": the end of the log first, so that the message is the last thing read.
fail_with_log() {
  printf -- '--- the end of %s ---\n' "$1" >&2
  tail -n 20 "$1" >&2
  printf -- '---\n' >&2
  fail 1 "$2"
}

have() { command -v "$1" >/dev/null 2>&1; }

free_mib() { df -Pk . | awk 'NR == 2 { print int($4 / 1024) }'; }

# The names in dependencies.txt, one a line.
dependencies() { sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$packages_file"; }

# Those that are not installed. A package left half-configured by an interrupted run counts as missing.
missing_packages() {
  local wanted
  mapfile -t wanted < <(dependencies)
  printf '%s\n' "${wanted[@]}" | grep -vxF -f <(
    dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^installed //p'
  )
}

# Sets `as_root` to what a command that needs root is started with.
find_root() {
  as_root=()
  [ "$(id -u)" -eq 0 ] && return
  local by_hand="as root run: apt-get install --no-install-recommends $*"
  have sudo || fail 2 "not root, and there is no sudo; $by_hand"
  as_root=(sudo)
  sudo -n true 2>/dev/null && return
  if [ ! -t 0 ] || [ ! -t 2 ]; then
    fail 2 "sudo wants a password and there is no terminal to ask on; $by_hand"
  fi
  say "sudo may ask for your password, to install packages"
  sudo -v || fail 2 "sudo was refused; $by_hand"
}

apt_get() {
  "${as_root[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get \
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=2 -o Acquire::http::Timeout=30 \
    "$@" </dev/null >>"$apt_log" 2>&1
}

apt_install() { apt_get install -y --no-install-recommends "$@"; }

# Says why apt failed, from its log: what the user must do differs.
explain_apt_failure() {
  logged() { grep -Eq "$1" "$apt_log"; }
  if logged "Could not get lock|Unable to acquire the dpkg frontend lock|Unable to lock directory"; then
    fail_with_log "$apt_log" "apt is in use by another program; wait until that is done and run $me again"
  elif logged "enough free space|No space left on device"; then
    fail_with_log "$apt_log" "there is no room for the packages; free some disk space and run $me again"
  elif logged "Sub-process .*dpkg returned an error"; then
    fail_with_log "$apt_log" "dpkg could not install a package; mend what the lines above say and run $me again"
  elif logged "Failed to fetch|Temporary failure resolving|Could not resolve|Unable to connect|Could not connect"; then
    fail_with_log "$apt_log" "apt cannot fetch packages; check the network and the sources in /etc/apt, then run $me again"
  elif logged "Unable to locate package|has no installation candidate"; then
    fail_with_log "$apt_log" "apt does not know every package in $packages_file, which are Debian 12's; use Debian 12 or newer, or install their equivalents by hand and run ./$me --no-install"
  fi
  fail_with_log "$apt_log" "apt could not install the packages; mend what the lines above say and run $me again"
}

install_packages() {
  if ! have apt-get || ! have dpkg-query; then
    fail 2 "this system has no apt-get; install the equivalents of these Debian packages by hand, then run ./$me --no-install: $(dependencies | paste -sd ' ')"
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  [ "${#missing[@]}" -eq 0 ] && return
  find_root "${missing[@]}"

  apt_log="$logs/apt.log"
  : >"$apt_log" || fail 1 "cannot write $root/$apt_log; check the rights on build/ and the room on the disk"
  say "installing ${#missing[@]} packages with apt: ${missing[*]} (log: $apt_log)"
  # A failed update is no reason to stop: one dead source of many does not matter, and the lists may be good enough.
  apt_get update
  if ! apt_install "${missing[@]}"; then
    grep -q "dpkg was interrupted" "$apt_log" || explain_apt_failure
    say "finishing an interrupted installation: dpkg --configure -a"
    "${as_root[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive dpkg --configure -a </dev/null >>"$apt_log" 2>&1
    apt_install "${missing[@]}" || explain_apt_failure
  fi
  mapfile -t missing < <(missing_packages)
  [ "${#missing[@]}" -eq 0 ] ||
    fail_with_log "$apt_log" "apt said it was done but these are still missing: ${missing[*]}; install them by hand"
}

check_tools() {
  local tool compiler
  for tool in cmake ninja pkg-config; do
    have "$tool" || fail 2 "$tool is not on the PATH; install it, or put its folder on the PATH"
  done
  read -r compiler _ <<<"${CXX:-c++}"
  have "$compiler" || fail 2 "there is no C++ compiler '$compiler'; install g++, or set CXX to a C++20 compiler"
}

check_room() {
  local need=$room_first_mib free
  [ -x "$build_dir/bin/limber" ] && need=$room_again_mib
  free=$(free_mib)
  [ "$free" -ge "$need" ] ||
    fail 1 "there is no room in $root: $free MiB free, $need MiB needed; free some disk space and run $me again"
}

# Always: it takes a second. A build folder that an interrupted run or another place left unusable is begun anew.
configure() {
  local log="$logs/configure.log"
  say "configuring $build_dir (log: $log)"
  cmake --preset "$preset" </dev/null >"$log" 2>&1 && return
  say "configuring anew, without what the last run left"
  cmake --fresh --preset "$preset" </dev/null >"$log" 2>&1 ||
    fail_with_log "$log" "cmake could not configure the build; mend what the lines above say and run $me again"
}

build() {
  say "building $build_dir with $(nproc) cores"
  cmake --build --preset "$preset" </dev/null && return
  [ "$(free_mib)" -ge "$room_again_mib" ] || fail 1 "there is no room left in $root; free some disk space and run $me again"
  fail 1 "the build failed, see the first error above; if you changed no source, remove $root/$build_dir and run $me again"
}

# One set-up at a time in a build folder; the lock goes when this process does.
take_turn() {
  have flock || return
  exec 9>build/.lock
  flock -n 9 && return
  say "waiting for another run in this folder"
  flock 9
}

# set_up INSTALL: everything up to a finished build. INSTALL is yes or no.
set_up() {
  cd -- "$root" || fail 1 "cannot enter $root; check the rights on it"
  { mkdir -p "$logs" && [ -w "$logs" ] && [ -w build ] && : >"$logs/probe"; } 2>/dev/null ||
    fail 1 "cannot write $root/build ($(free_mib) MiB free); free some disk space, or make the folder yours (an earlier run as root makes it root's): sudo chown -R \"\$USER\" build"
  rm -f "$logs/probe"
  take_turn
  check_room
  [ "$1" = no ] || install_packages
  check_tools
  configure
  build
}
