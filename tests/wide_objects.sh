#!/bin/bash
# wide_objects.sh NM ENTRY=OBJECT…: every wide object defines its entry and no other global symbol.
# Weak (w, v) and unique (u) definitions count as global: they are what the linker would merge.
set -euo pipefail
nm=$1
shift
short=0
for pair in "$@"; do
  entry=${pair%%=*} object=${pair#*=}
  exported=$("$nm" --defined-only --format=posix "$object" | awk '$2 ~ /^[A-Zuvw]$/ { print $1 }')
  if [[ $exported == "$entry" ]]; then
    echo "$object exports $entry alone"
  else
    echo "$object must export $entry alone; it exports: ${exported:-nothing}"
    short=1
  fi
done
exit $short
