#!/bin/sh
# Flies one fault test in one process: fly.sh SKEIN FILE NUMBER REPEATS OUT. NUMBER and SKEIN_TURN decide whether this
# run of the suite flies it: in one of three turns once, and in one of six turns also again, in the ways that REPEATS
# lists. If REPEATS is `only`, it is flown once, in one of six turns. Without SKEIN_TURN, it is always flown. The long
# suite repeats it in every way.
set -eu
has_turn() { [ -z "${SKEIN_TURN:-}" ] || [ $((($1 + SKEIN_TURN) % $2)) -eq 0 ]; }
turns=3
[ "$4" != only ] || turns=6
has_turn "$3" "$turns" || { echo "not its turn"; exit 77; }
how=
if [ "${SKEIN_LONG:-}" = 1 ]; then
  how=--long
elif [ "$4" != only ] && has_turn "$3" 6; then
  how="--repeat $4"
fi
# shellcheck disable=SC2086  # may be two words
exec "$1" test --faults "$2" --one-process $how --out "$5"
