#!/usr/bin/env bash
# What bash offers, and that manual and completions know everything that --help lists.
# completion.test.sh PROGRAM
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir runs
touch a.yaml x.txt
for kind in bash zsh man; do "$program" completion $kind >"$kind"; done
# shellcheck source=/dev/null
source ./bash
compopt() { :; } # only allowed while bash completes

failures=0
# offers WORDS... -- EXPECTED: what stands there after Tab behind the last of WORDS
offers() {
  COMP_WORDS=()
  while [ "$1" != -- ]; do COMP_WORDS+=("$1") && shift; done
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _flowslide "$program"
  [ "${COMPREPLY[*]}" = "$2" ] && return
  echo "FAILED: '${COMP_WORDS[*]}' gives '${COMPREPLY[*]}' instead of '$2'"
  failures=$((failures + 1))
}
offers flowslide ins -- inspect
offers flowslide run --dry -- --dry-run
offers flowslide run '' -- 'a.yaml runs'
offers flowslide run a.yaml --out '' -- runs
offers flowslide run a.yaml --set '' -- ''
offers flowslide report '' -- runs
offers flowslide inspect x -- x.txt
offers flowslide run a.yaml --dry-run '' -- 'a.yaml runs'
offers flowslide motion --pga '' -- ''
offers flowslide verify fem/f4_c -- fem/f4_cryer

commands=$("$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]\+\) .*/\1/p')
[ "$(wc -w <<<"$commands")" -ge 12 ] || { echo "FAILED: commands are '$commands'"; failures=1; }
declare -A text
for kind in bash zsh man; do text[$kind]=$(sed 's/\\-/-/g' $kind); done
for command in $commands; do
  options=$("$program" "$command" --help | grep -o -- '^  [-,a-z]*--[a-z-]*' | grep -o -- '--[a-z-]*$')
  for word in "$command" $options; do
    for kind in bash zsh man; do
      grep -qE -- "(^|[^a-z-])$word([^a-z-]|\$)" <<<"${text[$kind]}" && continue
      echo "FAILED: '$word' of '$command' is not in the $kind text"
      failures=$((failures + 1))
    done
  done
done
if command -v groff >/dev/null; then
  warnings=$(groff -man -Tascii -P-cbu -ww man 2>&1 >man.txt)
  [ -z "$warnings" ] || { echo "FAILED: $warnings"; failures=$((failures + 1)); }
  grep -q -- '--dry-run' man.txt || { echo "FAILED: the manual lacks --dry-run"; failures=$((failures + 1)); }
fi
! command -v zsh >/dev/null || zsh -n zsh || failures=$((failures + 1))
[ $failures -eq 0 ] || exit 1
echo "all of it holds"
