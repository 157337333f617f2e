#!/bin/sh
# Kills fits at random moments and lets them go on: whatever happens, the answer is the same.
#   kill_fits.sh HAVERS STUDY.toml KILLS
set -eu
havers=$1 study=$2 kills=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

answer() {
  python3 -c 'import json, sys
r = json.load(open(sys.argv[1]))
print(r["cost"], r["evaluations"], [(p["name"], p["value"], p["interval_95"]) for p in r["parameters"]])' "$1/result.json"
}

begin=$(date +%s%N)
"$havers" fit "$study" -o "$work/whole" -q > /dev/null || true
took=$(( ($(date +%s%N) - begin) / 1000000 ))
expected=$(answer "$work/whole")

done=0 finished=0
while [ "$done" -lt "$kills" ]; do
  "$havers" fit "$study" -o "$work/fit" -q > /dev/null 2>&1 &
  fit=$!
  sleep "$(awk -v t="$took" -v s="$done" 'BEGIN { srand(s); printf "%.3f", rand() * t / 2000 }')"
  if kill -9 "$fit" 2> /dev/null; then done=$((done + 1)); fi
  wait "$fit" 2> /dev/null || true
  [ -f "$work/fit/result.json" ] || continue
  [ "$(answer "$work/fit")" = "$expected" ] || { echo "another answer after $done kills" >&2; exit 1; }
  finished=$((finished + 1))
  rm -rf "$work/fit"
done
"$havers" fit "$study" -o "$work/fit" -q > /dev/null || true
[ "$(answer "$work/fit")" = "$expected" ] || { echo "another answer at the end" >&2; exit 1; }
echo "$done kills, $((finished + 1)) fits finished, every one with the same answer"
