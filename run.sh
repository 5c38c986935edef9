#!/usr/bin/env bash
# ./run.sh [WORKFLOW] [args]: installs what is missing, builds, runs a workflow.
set -euo pipefail
start=$PWD
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$root/cmake/build.sh" flowslide
workflow="$root/workflows/mochikoshi-static.yaml"
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  workflow=$1
  shift
fi
cd "$start"
exec "$root/build/release/flowslide" run "$workflow" "$@"
