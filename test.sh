#!/usr/bin/env bash
# ./test.sh [ctest options]: installs what is missing, builds, runs every test.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$root/cmake/build.sh" all
cd "$root"
exec ctest --preset release "$@"
