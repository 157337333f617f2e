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

# A finished fit, which a kill may have met while its files were put in place, has all of them.
check() {
  [ "$(answer "$work/fit")" = "$expected" ] || { echo "another answer after $done kills" >&2; exit 1; }
  [ "$(cd "$work/fit" && find . -type f ! -name 'evaluations.sqlite*' | sort)" = "$files" ] ||
    { echo "files are missing after $done kills" >&2; exit 1; }
}

begin=$(date +%s%N)
"$havers" fit "$study" -o "$work/whole" -q > /dev/null || true
took=$(( ($(date +%s%N) - begin) / 1000000 ))
expected=$(answer "$work/whole")
files=$(cd "$work/whole" && find . -type f ! -name 'evaluations.sqlite*' | sort)

# Moments are uniform over the time of a whole fit.
done=0 tries=0 finished=0
while [ "$done" -lt "$kills" ]; do
  "$havers" fit "$study" -o "$work/fit" -q > /dev/null 2>&1 &
  fit=$!
  tries=$((tries + 1))
  sleep "$(awk -v t="$took" -v s="$tries" 'BEGIN { srand(s); rand(); printf "%.3f", rand() * t / 1000 }')"
  if kill -9 "$fit" 2> /dev/null; then done=$((done + 1)); fi
  wait "$fit" 2> /dev/null || true
  [ -f "$work/fit/result.json" ] || continue
  check
  finished=$((finished + 1))
  rm -rf "$work/fit"
done
"$havers" fit "$study" -o "$work/fit" -q > /dev/null || true
check
echo "$done kills, $((finished + 1)) fits finished, every one with the same answer (a whole fit took $took ms)"
