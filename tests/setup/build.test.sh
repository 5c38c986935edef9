#!/usr/bin/env bash
# Drives cmake/build.sh in a folder of its own, where apt-get, sudo and cmake are doubles that write
# down how they were called. build.test.sh SOURCE
set -euo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# A checkout with what build.sh needs, and a PATH with the system's tools but without sudo.
fresh() {
  rm -rf "${folder:?}"/*
  mkdir -p "$folder/bin" "$folder/checkout/cmake"
  cp "$source/cmake/build.sh" "$folder/checkout/cmake/"
  for tool in bash env dirname mktemp tail tee sed rm cat; do
    ln -s "$(command -v "$tool")" "$folder/bin/$tool"
  done
  double id 'echo 0'
  double dpkg-query 'case "$*" in *libfmt-dev*|*catch2*) exit 1 ;; esac; printf "install ok installed"'
  double apt-get 'case "$*" in
    *--print-uris*) echo "0 upgraded, 7 newly installed, 0 to remove and 2 not upgraded."
      echo "Need to get 3456 kB of archives."
      echo "After this operation, 12.5 MB of additional disk space will be used." ;;
    *Status-Fd*) echo "Get:1 something"; echo "dlstatus:1:80.0:Retrieving file 1 of 2"
      echo "pmstatus:libfmt9:50.0:Unpacking libfmt9 (amd64)"; echo "pmstatus:libfmt9:100.0:Done" ;;
  esac'
  double cmake 'case "$*" in
    --preset*) mkdir -p build/release; : >build/release/CMakeCache.txt; : >build/release/build.ninja ;;
    --build*) n=20; for i in $(seq $n); do echo "[$i/$n] Building CXX object core/a_$i.cpp.o"; done ;;
  esac'
  for tool in mkdir seq; do ln -s "$(command -v "$tool")" "$folder/bin/$tool"; done
}

double() {
  printf '#!%s\necho "%s $*" >>"%s/calls"\n%s\n' "$(command -v bash)" "$1" "$folder" "$2" >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}

build() {
  code=0
  PATH="$folder/bin" "$folder/checkout/cmake/build.sh" flowslide >"$folder/out" 2>"$folder/err" || code=$?
}

expect() {
  local what=$1
  shift
  "$@" && return
  echo "FAILED: $what; exit code $code"
  sed 's/^/  /' "$folder/err" "$folder/calls"
  failures=$((failures + 1))
}
says() { grep -qF -- "$1" "$folder/err"; }
called() { grep -qF -- "$1" "$folder/calls"; }
not() { ! "$@"; }
line_of() { grep -nF -m1 -- "$1" "$2" | cut -d: -f1; }

fresh
build
expect "missing packages are installed" test "$code" -eq 0
expect "their number and size are told" says "installing 7 packages: 3456 kB to download, 12.5 MB on the disk"
expect "before it happens" test "$(line_of 'installing 7' "$folder/err")" -lt "$(line_of 'installing 75' "$folder/err")"
expect "only what is missing" called "--no-install-recommends -o APT::Status-Fd=1 libfmt-dev catch2"
expect "progress of apt" says "installing 40 %"
expect "progress of the compiler" says "compiling 50 %"
expect "plain lines where there is no terminal" not grep -q $'\r' "$folder/err"
expect "the output stays free for the program" test ! -s "$folder/out"
expect "a fresh checkout is configured" called "cmake --preset release"
expect "the target is built" called "cmake --build --preset release --target flowslide"

rm "$folder/calls"
double dpkg-query 'printf "install ok installed"'
double cmake 'echo "[1/2] Generating program_version_values.hpp"'
build
expect "nothing to do is quiet" test "$code" -eq 0 -a ! -s "$folder/err"
expect "nothing is configured again" not called "cmake --preset"
rm "$folder/checkout/build/release/CMakeCache.txt"
build
expect "a folder without a cache is configured" called "cmake --preset release"

fresh
double id 'echo 1000'
build
expect "without root and sudo the exit code is 1" test "$code" -eq 1
expect "the administrator gets the line" says "apt-get install -y --no-install-recommends libfmt-dev catch2"
expect "nothing is tried" not called "apt-get"

double sudo 'exit 1'
build
expect "a refusing sudo ends with 1" test "$code" -eq 1
expect "and the same line" says "apt-get install -y --no-install-recommends libfmt-dev catch2"

double sudo '[ "$1" = -v ] || exec "$@"'
build
expect "sudo installs" test "$code" -eq 0
expect "as root" called "sudo env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get install"

double cmake 'case "$*" in --build*)
  echo "[1/20] Building a.cpp.o"; echo "a.cpp:1:2: warning: odd"; echo " 1 | int a"; echo "[2/20] b" ;; esac'
build
expect "a warning of the compiler is shown" says "a.cpp:1:2: warning: odd"
expect "with its place" says " 1 | int a"
expect "and does not fail the build" test "$code" -eq 0

double cmake 'case "$*" in --build*)
  for i in $(seq 100); do echo "line $i"; done; echo "a.cpp:1: error: no"; exit 1 ;; esac'
build
expect "a failed build ends with 1" test "$code" -eq 1
expect "the end of its output is shown" says "a.cpp:1: error: no"
expect "60 lines of it" not grep -qx "line 41" "$folder/err"
expect "and not fewer" grep -qx "line 42" "$folder/err"

fresh
double dpkg-query 'printf "install ok installed"'
code=0
PATH="$folder/bin" "$(command -v script)" -qec "$folder/checkout/cmake/build.sh flowslide" /dev/null \
  >"$folder/err" </dev/null || code=$?
expect "one line is redrawn on a terminal" says $'\r\033[Kcompiling 50 %'
expect "and is gone at the end" test "$(tail -c 4 "$folder/err")" = $'\r\033[K'

fresh
double dpkg-query 'case "$*" in *clang*) exit 1 ;; esac; printf "install ok installed"'
double cmake 'case "$*" in --preset*) mkdir -p build/fuzz ;; esac'
code=0
PATH="$folder/bin" "$folder/checkout/cmake/build.sh" --preset asan one two 2>"$folder/err" || code=$?
expect "another preset needs its own packages" called "Status-Fd=1 clang libclang-rt-dev"
expect "and builds all targets named" called "cmake --build --preset asan --target one two"

fresh
rm "$folder/bin/apt-get" "$folder/bin/dpkg-query"
build
expect "other systems build with what they have" test "$code" -eq 0
expect "and are told what that must be" says "no apt-get here"

[ $failures -eq 0 ] || exit 1
echo "all of it holds"
