#!/bin/sh
# Flies one fault test in one process: SKEIN FILE NUMBER REPEATS OUT. It is flown again in the ways of REPEATS when its
# number has its turn (SKEIN_TURN; without it always), or it is flown then alone, where REPEATS is `only`. The long
# suite repeats it in every way.
set -eu
turns=3
[ "$4" != only ] || turns=6
turn=true
[ -z "${SKEIN_TURN:-}" ] || [ $((($3 + SKEIN_TURN) % turns)) -eq 0 ] || turn=false
how=
if [ "$4" = only ]; then
  "$turn" || { echo "not its turn"; exit 77; }
elif [ "${SKEIN_LONG:-}" = 1 ]; then
  how=--long
elif "$turn"; then
  how="--repeat $4"
fi
# shellcheck disable=SC2086  # two words
exec "$1" test --faults "$2" --one-process $how --out "$5"
