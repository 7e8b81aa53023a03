#!/bin/sh
# Flies one fault test in one process: SKEIN FILE REPEATS OUT; REPEATS may be none.
# The long suite repeats it in every way.
set -eu
how=
[ "$3" = none ] || how="--repeat $3"
[ "${SKEIN_LONG:-}" != 1 ] || how=--long
# shellcheck disable=SC2086  # two words
exec "$1" test --faults "$2" --one-process $how --out "$4"
