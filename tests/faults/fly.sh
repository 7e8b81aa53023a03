#!/bin/sh
# Flies one fault test in one process: SKEIN FILE NUMBER REPEATS OUT. By its number it is flown in one of two turns
# (SKEIN_TURN; without it always), and in one of four again, in the ways of REPEATS. Where REPEATS is `only`, it is
# flown in one of six turns, once. The long suite repeats it in every way.
set -eu
has_turn() { [ -z "${SKEIN_TURN:-}" ] || [ $((($1 + SKEIN_TURN) % $2)) -eq 0 ]; }
turns=2
[ "$4" != only ] || turns=6
has_turn "$3" "$turns" || { echo "not its turn"; exit 77; }
how=
if [ "${SKEIN_LONG:-}" = 1 ]; then
  how=--long
elif [ "$4" != only ] && has_turn "$3" 4; then
  how="--repeat $4"
fi
# shellcheck disable=SC2086  # two words
exec "$1" test --faults "$2" --one-process $how --out "$5"
