#!/usr/bin/env bash
# tests/bits/run.sh [ARCH ...]: builds the program `bits` for instruction sets that this machine has
# [x86-64-v2 x86-64-v3, and x86-64-v4 where it runs] and compares what they print, with one and two
# threads, and with the C library told that the processor is an old one.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sets=("$@")
if [ ${#sets[@]} -eq 0 ]; then
  sets=(x86-64-v2 x86-64-v3)
  grep -q avx512vl /proc/cpuinfo && sets+=(x86-64-v4)
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for arch in "${sets[@]}"; do
  build="$root/build/$arch"
  cmake -S "$root" --preset release -B "$build" "-DFLOWSLIDE_ARCH=$arch" > "$out/log" ||
    { cat "$out/log"; exit 1; }
  cmake --build "$build" --target bits > "$out/log" || { cat "$out/log"; exit 1; }
  # What depends on the instruction set shows here only.
  ! grep -A 3 'warning:' "$out/log" || exit 1
  for threads in 1 2; do
    "$build/tests/bits/bits" "$threads" > "$out/$arch.$threads"
  done
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F,-AVX512VL \
    "$build/tests/bits/bits" 1 > "$out/$arch.old"
done
first="$out/${sets[0]}.1"
failed=0
for other in "$out"/*.1 "$out"/*.2 "$out"/*.old; do
  if ! cmp -s "$first" "$other"; then
    echo "${sets[0]}.1 and $(basename "$other") differ:"
    diff "$first" "$other" || true
    failed=1
  fi
done
[ $failed -eq 0 ] && echo "$(wc -l < "$first") digests equal for ${sets[*]}, 1 and 2 threads"
exit $failed
