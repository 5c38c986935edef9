#!/usr/bin/env bash
# cmake/build.sh TARGET: installs missing Debian packages, then configures and builds the preset
# release. Quiet unless something goes wrong.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  g++ cmake ninja-build ccache git ca-certificates
  libeigen3-dev libfmt-dev libssl-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev zlib1g-dev
  libhdf5-dev libvtk9-dev catch2 python3 python3-numpy python3-matplotlib
)
missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "installing: ${missing[*]}" >&2
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() {
  "$@" >"$log" 2>&1 && return
  tail -n 60 "$log" >&2
  echo "error: '$*' failed; the last lines of its output are above" >&2
  exit 1
}
[ -f build/release/CMakeCache.txt ] && [ -f build/release/build.ninja ] || quietly cmake --preset release
quietly cmake --build --preset release --target "$1"
