#!/bin/bash
# A sweep on Slurm, really: two virtual nodes on this machine run the Snakefile's jobs, one node is
# drained and one job killed in the middle, and the end must be that of `halfstep sweep --jobs 1`,
# byte for byte but for times.
#   tests/slurm/run.sh [HALFSTEP [SWEEP.yaml [CASES_A_JOB]]]
# Installs nothing. Needs munged, slurmctld, slurmd and snakemake (Debian: slurm-wlm munge snakemake);
# exit status 77, which ctest counts as skipped, without them. Leaves no process and no file.
set -euo pipefail
source_folder=$(cd "$(dirname "$0")/../.." && pwd)
halfstep=$(realpath "${1:-$source_folder/build/release/experiments/halfstep}")
sweep=$(realpath "${2:-$source_folder/experiments/sweeps/bar_8cm_duration_clearance.yaml}")
batch=${3:-10}
PATH=$PATH:/usr/sbin
for tool in munged slurmctld slurmd sbatch scontrol snakemake; do
  if ! command -v "$tool" >/dev/null; then
    echo "Skipped: there is no $tool (Debian's packages slurm-wlm, munge, snakemake)"
    exit 77
  fi
done

place=$(mktemp -d /tmp/halfstep_slurm_XXXXXX)
daemons=()
stop() {
  trap - EXIT INT TERM
  [ -z "${snake:-}" ] || kill "$snake" 2>/dev/null || true
  scancel --user="$(id -un)" 2>/dev/null || true
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do kill "${daemons[i]}" 2>/dev/null || true; done
  for pid in "${daemons[@]}"; do
    for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || break; sleep 0.1; done
    kill -9 "$pid" 2>/dev/null || true
  done
  [ -n "${KEEP:-}" ] || rm -rf "$place"
}
trap stop EXIT INT TERM

# What failed, with the ends of the logs.
fail() {
  echo "$1" >&2
  tail -n 20 "$place"/*.log >&2 || true
  exit 1
}
until_true() { # seconds, command
  local end=$((SECONDS + $1))
  until "${@:2}" >/dev/null 2>&1; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.2
  done
}

export SLURM_CONF=$place/slurm.conf
port=$((20000 + $$ % 20000))
sed -e "s|@HOST@|$(hostname -s)|; s|@USER@|$(id -un)|; s|@PLACE@|$place|" \
  -e "s|@PORT@|$port|; s|@PORT1@|$((port + 1))|; s|@PORT2@|$((port + 2))|" \
  "$source_folder/tests/slurm/slurm.conf.in" >"$SLURM_CONF"
chmod 711 "$place"
mkdir "$place/state" "$place/spool-step1" "$place/spool-step2"
(umask 077 && head -c 1024 /dev/urandom >"$place/munge.key")
munged --foreground --force --key-file="$place/munge.key" --socket="$place/munge.socket" \
  --pid-file="$place/munged.pid" --log-file="$place/munged.log" --seed-file="$place/munge.seed" \
  >"$place/munged-screen.log" 2>&1 &
daemons+=($!)
until_true 10 munge --no-input --socket="$place/munge.socket" || fail "munged does not answer"
slurmctld -D -i >"$place/slurmctld-screen.log" 2>&1 &
daemons+=($!)
for node in step1 step2; do
  slurmd -D -N "$node" >"$place/$node-screen.log" 2>&1 &
  daemons+=($!)
done
both_idle() { [ "$(sinfo --noheader --Node --states=idle --format=%N | wc -l)" = 2 ]; }
until_true 30 both_idle || fail "the two nodes do not come up: $(sinfo 2>&1)"
echo "Slurm $(slurmctld -V | cut -d' ' -f2), nodes: $(sinfo --noheader --Node --format='%N %t' | paste -sd,)"

cd "$place"
out=$place/swept
done_cases() { ls "$out/cases" 2>/dev/null | wc -l; }
begin=$SECONDS
snakemake --snakefile "$source_folder/experiments/sweeps/Snakefile" --nolock \
  --profile "$source_folder/experiments/sweeps/profiles/slurm" --latency-wait 10 \
  --config sweep="$sweep" out="$out" halfstep="$halfstep" batch="$batch" >snakemake.log 2>&1 &
snake=$!
some_done() { [ "$(done_cases)" -ge "$batch" ] && [ -n "$(squeue --noheader --states=R -o %A)" ]; }
until_true 120 some_done || fail "no case is done"
scontrol update nodename=step2 state=drain reason=test
job=$(squeue --noheader --states=R --format=%A | head -n 1)
scancel --signal=KILL --full "$job"
echo "At $(done_cases) cases done: step2 drained, job $job killed"
sleep 5
echo "$(done_cases) cases done later: $(sinfo --noheader --Node --format='%N %t' | paste -sd,)"
scontrol update nodename=step2 state=resume
wait "$snake" || fail "snakemake failed"
snake=
seconds=$((SECONDS - begin))
scontrol --oneliner show jobs | grep -o 'JobState=[A-Z_]*' | sort | uniq -c | sed 's/^ */jobs: /'
grep -c '^Trying to restart job' snakemake.log | sed 's/^/jobs that Snakemake began again: /' || true

begin=$SECONDS
"$halfstep" sweep "$sweep" --jobs 1 --out reference --quiet
echo "$(done_cases) cases: $seconds s on Slurm, $((SECONDS - begin)) s by --jobs 1"
diff --recursive --brief --exclude=timings.csv reference swept || fail "the two differ"
cmp <(cut -d, -f1,2 reference/timings.csv) <(cut -d, -f1,2 swept/timings.csv)
[ "$(ls -d -- *.jobs 2>/dev/null | wc -l)" = 0 ] || fail "marks are left"
files=$(find swept -type f ! -name timings.csv | wc -l)
echo "Byte-identical: $files files, runs.csv $(sha256sum swept/runs.csv | cut -c1-16)"
