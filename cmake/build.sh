#!/usr/bin/env bash
# cmake/build.sh [--preset NAME] TARGET...: installs missing Debian packages, then configures and
# builds a preset, release unless named. Says beforehand what it installs; everything that it prints
# goes to the standard error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
exec 1>&2
preset=release
if [ "$1" = --preset ]; then
  preset=$2
  shift 2
fi

# python3-munkres stands in for SciPy, which apt would take as the first alternative of Matplotlib's
# fonttools: 350 MB less (docs/adr/0013-packages.md). VTK is used where it is found, never installed.
packages=(
  g++ cmake ninja-build ccache git ca-certificates
  libeigen3-dev libfmt-dev libssl-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev zlib1g-dev
  libhdf5-dev catch2 python3 python3-numpy python3-munkres python3-matplotlib
)
case $preset in
  race | asan | tidy) packages+=(clang llvm libclang-rt-dev libomp-dev) ;;
esac
install=(apt-get install -y --no-install-recommends)

log=$(mktemp)
trap 'rm -f "$log"' EXIT
terminal=false
[ -t 2 ] && terminal=true

fail() {
  printf '%s\n' "$@"
  exit 1
}

# show LABEL: reads lines "DONE TOTAL TEXT" and tells how far things are: one line that is redrawn on
# a terminal, a line at every tenth elsewhere.
show() {
  local label=$1 done total text tenth last=0 start=$SECONDS left line
  while read -r done total text; do
    [ "$total" -gt 0 ] || continue
    left=''
    [ $((SECONDS - start)) -lt 5 ] || [ "$done" -eq 0 ] ||
      left="$(clock $(((SECONDS - start) * (total - done) / done))) left  "
    line="$label $((100 * done / total)) %  $left"
    tenth=$((10 * done / total))
    if $terminal; then
      line+=$text
      printf '\r\033[K%s' "${line:0:79}"
    elif [ "$tenth" -gt "$last" ]; then
      printf '%s\n' "${line%"${line##*[! ]}"}"
      last=$tenth
    fi
  done
  ! $terminal || printf '\r\033[K'
}

clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# with_progress LABEL PARSER COMMAND...: its output into the log, and what PARSER makes of it shown.
with_progress() {
  local label=$1 parser=$2 failed=0
  shift 2
  "$@" 2>&1 | tee "$log" | "$parser" | show "$label" || failed=1
  [ $failed -eq 0 ] || fail_with_log "$*"
}

fail_with_log() {
  tail -n 60 "$log"
  fail "error: '$1' failed; the last lines of its output are above"
}

quietly() { "$@" >"$log" 2>&1 || fail_with_log "$*"; }

# "dlstatus:3:41.5:Retrieving file 3 of 9" and "pmstatus:libfmt9:62.1:Unpacking libfmt9": the first
# half is for downloads, the second for the packages.
of_apt() {
  local kind percent text
  while IFS=: read -r kind _ percent text; do
    percent=${percent%%[.,]*}
    [[ $percent =~ ^[0-9]+$ ]] || continue
    case $kind in
      dlstatus) echo "$((percent / 2)) 100 $text" ;;
      pmstatus) echo "$((50 + percent / 2)) 100 $text" ;;
    esac
  done
}

# "[12/480] Building CXX object core/CMakeFiles/flowslide_core.dir/units.cpp.o" with NINJA_STATUS. A
# few steps are over before anybody reads of them.
of_ninja() {
  local line
  while read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (.*)$ ]] && [ "${BASH_REMATCH[2]}" -ge 10 ] || continue
    echo "${BASH_REMATCH[1]} ${BASH_REMATCH[2]} ${BASH_REMATCH[3]##*/}"
  done
}

install_missing() {
  local as_root=() ask
  ask="  ${install[*]} ${missing[*]}"
  echo "not installed yet: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "error: packages are missing (you are not root and there is no sudo)" \
        "Ask the administrator of this machine for" "$ask"
    as_root=(sudo)
    sudo -v || fail "error: packages are missing (sudo refused)" \
      "Ask the administrator of this machine for" "$ask"
  fi
  echo "looking up their sizes (apt-get update)"
  quietly "${as_root[@]}" apt-get update -qq
  LC_ALL=C "${install[@]}" --print-uris "${missing[@]}" >"$log" 2>&1 || fail_with_log "${install[*]}"
  announce
  with_progress "installing" of_apt "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C \
    "${install[@]}" -o APT::Status-Fd=1 "${missing[@]}"
}

# From "3 upgraded, 605 newly installed, ...", "Need to get 573 MB/580 MB of archives." and "After
# this operation, 2345 MB of additional disk space will be used."
announce() {
  local count get disk
  count=$(sed -n 's/^[0-9]* upgraded, \([0-9]*\) newly installed.*/\1/p' "$log")
  get=$(sed -n 's/^Need to get \([0-9.]* [kMG]\?B\).*/\1/p' "$log")
  disk=$(sed -n 's/^After this operation, \([0-9.]* [kMG]\?B\) of additional.*/\1/p' "$log")
  echo "installing ${count:-?} packages: ${get:-0 B} to download, ${disk:-0 B} on the disk"
}

missing=()
if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] || install_missing
else
  echo "note: no apt-get here; what Debian 12 calls ${packages[*]} must be installed already"
fi

{ [ -f "build/$preset/CMakeCache.txt" ] && [ -f "build/$preset/build.ninja" ]; } ||
  quietly cmake --preset "$preset"
export NINJA_STATUS='[%f/%t] '
with_progress "compiling" of_ninja cmake --build --preset "$preset" --target "$@"
# The line of progress swallows what the compiler says: there should be nothing.
sed -n '/warning:/,+3p' "$log"
