#!/usr/bin/env bash
# .ci/passed leaves out what has passed, and nothing else. passed.test.sh PASSED
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/.ci" "$scratch"/{fixtures,workflows,tests,docs,report}
cp "$1" "$scratch/.ci/passed"
cd "$scratch"
git init -q .
echo build > .gitignore
echo data > fixtures/data.txt
mkdir build
echo program > build/test_one

passed() { .ci/passed "$@" build one build/test_one > build/said; }
expect() {
  local want=$1 code=0
  passed || code=$?
  [ "$code" -eq "$want" ] || { echo "$2: ends with $code, not $want"; exit 1; }
}
expect 1 "nothing has passed"
passed --keep
expect 0 "as it was"
grep -q '^one: as it was' build/said
touch fixtures/data.txt
echo text > docs/page.md
echo 'int i;' > tests/a.cpp
expect 0 "pages and sources are no data"
git add fixtures
echo other > fixtures/data.txt
expect 1 "a fixture has changed"
passed --keep
echo new > workflows/w.yaml
expect 1 "a workflow that git does not know yet"
passed --keep
echo program2 > build/test_one
expect 1 "the program has changed"
passed --keep
! .ci/passed build two build/test_one > build/said || { echo "another name has passed"; exit 1; }
rm fixtures/data.txt
passed --keep
expect 0 "a file that git still knows is gone"
! .ci/passed --keep build one build/none > build/said 2>&1 || { echo "no program was kept"; exit 1; }
! .ci/passed build one build/none > build/said 2>&1 || { echo "no program has passed"; exit 1; }
