#!/bin/sh
# Flies one fault test: SKEIN FILE REPEAT OUT. The long suite repeats it in every way.
set -eu
[ "${SKEIN_LONG:-}" = 1 ] && how=--long || how="--repeat $3"
# shellcheck disable=SC2086  # two words
exec "$1" test --faults "$2" $how --out "$4"
