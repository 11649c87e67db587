#!/bin/sh
# Packs what is built here into a folder that runs on a machine with an OpenCL device and nothing else: no network,
# no compiler, no packages, only a processor and a glibc like this one's.
#
#   tools/device_bundle.sh FOLDER [BUILD]     BUILD (build/release) was built with tests; FOLDER is made anew
#   FOLDER/run.sh [SELECTOR] [devices|rates|bench|campaign|tests|large]...
#
# On the other machine run.sh takes device SELECTOR (gpu) and does all parts, in this order, in about ten minutes. Each program has
# LIMIT seconds (150), as drivers may compile kernels for long. What it leaves is under $OUT, or FOLDER/out: a log a test,
# the benchmark's JSON, and all that it printed in log.txt.
#
#   rates      cells a second from device memory to device memory
#   bench      `powercell bench`
#   campaign   diagrams whose walls are compared with those of this machine's device, saved here: pairs of seeds must be equal
#   tests      as many at a time as there are processors, fourteen at most
#   large      10^6 and 10^7 seeds in the cube in both precisions
set -eu
[ $# -ge 1 ] || { sed -n '2,20s/^# \{0,1\}//p' "$0"; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "${2:-$root/build/release}" && pwd)
rm -rf "$1"
mkdir -p "$1/bin" "$1/lib"
folder=$(cd "$1" && pwd)

for name in cl primitives seeds neighbors pairs clip collect diagram device_diagram laws oracles verify solid periodic cell \
  exact determinism device_rates; do
  [ -x "$build/tests/test_$name" ] || { echo "device_bundle.sh: $build/tests/test_$name is not built" >&2; exit 1; }
  cp "$build/tests/test_$name" "$folder/bin/"
done
cp "$build/apps/powercell" "$folder/bin/"
cp "$root/examples/data/bracket.mesh" "$folder/"

# All shared libraries but the C library's own, which belong to the machine.
for program in "$folder"/bin/*; do ldd "$program"; done | awk '$3 ~ /^\// {print $3}' | sort -u |
  grep -Ev '/(libc|libm|libdl|librt|libpthread|ld-linux[^/]*)\.so' | while read -r library; do
  cp -L "$library" "$folder/lib/"
done
strip "$folder"/bin/* "$folder"/lib/libpowercell*

cat > "$folder/cases.txt" <<'CASES'
cube-W0 cube random:100000
cube-W1 cube random:100000:0:2.3e-4
cube-W2 cube random:100000:0:1.86e-3
square-W1 square random:200000:0:2.5e-6
square-W2 square random:200000:0:2e-5
sphere-W1 sphere random:30000:0:1e-4
bracket-W0 bracket.mesh random:20000
periodic-W0 cube random:30000 --periodic
CASES

cat > "$folder/campaign.sh" <<'CAMPAIGN'
#!/bin/sh
# Prints a line for each case and precision: a hash of the pairs of seeds that share a wall. They are the same on every
# device, as decisions are exact.
set -eu
cd "$(dirname "$0")"
walls=$(mktemp)
trap 'rm -f "$walls"' EXIT
while read -r name domain seeds more; do
  for precision in float double; do
    bin/powercell diagram --domain "$domain" --seeds "$seeds" $more --precision "$precision" --walls "$walls" --quiet || {
      echo "$name $precision failed"
      continue
    }
    echo "$name $precision $(cut -d, -f1,2,4- "$walls" | sha256sum | cut -c1-16)"
  done
done < cases.txt
CAMPAIGN
# As FOLDER/run.sh will find its libraries. This machine's device is PoCL's, whose adjacency is CGAL's (docs/records/campaigns.md).
LD_LIBRARY_PATH="$folder/lib" POWERCELL_DEVICE="${POWERCELL_DEVICE:-cpu}" sh "$folder/campaign.sh" >"$folder/expected.txt"
! grep failed "$folder/expected.txt" || exit 1

cat > "$folder/run.sh" <<'RUN'
#!/bin/sh
set -u
here=$(cd "$(dirname "$0")" && pwd)
export POWERCELL_DEVICE="${1:-gpu}" LD_LIBRARY_PATH="$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- devices rates bench campaign tests large
failed=0
began=$(date +%s)
mkdir -p "${OUT:-$here/out}"
OUT=$(cd "${OUT:-$here/out}" && pwd)
export OUT LIMIT="${LIMIT:-150}"
at_most() { timeout "$LIMIT" "$@"; }
cd "$here" || exit 1

# Where the machine names no drivers to the loader, or none of its GPU, those that it has are named here.
if [ -z "${OCL_ICD_VENDORS:-}" ] && mkdir -p vendors 2>/dev/null && [ -w vendors ]; then
  cp /etc/OpenCL/vendors/*.icd vendors/ 2>/dev/null
  for driver in libnvidia-opencl.so.1 libamdocl64.so libigdrcl.so libpocl.so.2; do
    grep -qs "$driver" vendors/*.icd || ! ldconfig -p | grep -q "$driver" || echo "$driver" > "vendors/$driver.icd"
  done
  export OCL_ICD_VENDORS="$here/vendors"
fi

run_test() {
  name=$(basename "$1")
  start=$(date +%s)
  if at_most "$1" > "$OUT/$name.log" 2>&1; then verdict=passed; else verdict="FAILED ($?)"; fi
  echo "$name $verdict, $(($(date +%s) - start)) s: $(grep 'test cases' "$OUT/$name.log" | tail -n 1)"
}
[ "${1-}" != --test ] || { run_test "$2"; exit; }

(
  for part in "$@"; do
    echo "== $part, after $(($(date +%s) - began)) s"
    case $part in
      devices) bin/powercell devices || exit 1 ;;
      rates) at_most bin/test_device_diagram -tc='rates*' --no-skip || failed=1 ;;
      bench) at_most bin/powercell bench --device "$POWERCELL_DEVICE" --json "$OUT/bench.json" || failed=1 ;;
      campaign)
        at_most sh campaign.sh > "$OUT/campaign.txt"
        if diff expected.txt "$OUT/campaign.txt"; then echo "walls are those expected in all cases"; else failed=1; fi ;;
      tests)
        jobs=$(nproc)
        [ "$jobs" -le 14 ] || jobs=14
        ls bin/test_* | xargs -P "$jobs" -I{} sh "$here/run.sh" "$POWERCELL_DEVICE" --test {} > "$OUT/tests.txt"
        cat "$OUT/tests.txt"
        ! grep -q FAILED "$OUT/tests.txt" || failed=1 ;;
      large)
        for precision in float double; do
          for n in 1000000 10000000; do
            at_most bin/powercell bench --device "$POWERCELL_DEVICE" --domain cube --precision "$precision" --n "$n" \
              --json "$OUT/cube-$precision-$n.json" || failed=1
          done
        done ;;
      *) echo "run.sh: $part is none of devices, rates, bench, campaign, tests and large" >&2; exit 2 ;;
    esac
  done
  echo "== done after $(($(date +%s) - began)) s, $([ $failed = 0 ] && echo 'all well' || echo 'with failures')"
  [ $failed = 0 ]
) > "$OUT/log.txt" 2>&1
status=$?
cat "$OUT/log.txt"
exit $status
RUN
chmod +x "$folder/run.sh"
du -sh "$folder" | awk '{print "device_bundle.sh: " $1 " in " $2}'
