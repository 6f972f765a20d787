#!/bin/sh
# Runs the tests of a suite at once, a process each: they wait by the wall clock and compute little.
#   at_once.sh PROGRAM SUITE
program=$1 suite=$2
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
names=$("$program" --gtest_list_tests --gtest_filter="$suite.*" | sed -n 's/^  \([^ ]*\).*/\1/p')
[ -n "$names" ] || { echo "$program has no $suite"; exit 1; }
for name in $names; do
  { "$program" --gtest_filter="$suite.$name" > "$place/$name" 2>&1 || touch "$place/failed"; } &
done
wait
cat "$place"/*
[ ! -e "$place/failed" ]
