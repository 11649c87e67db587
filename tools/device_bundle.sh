#!/bin/sh
# Packs what is built here into a folder that runs on a machine with an OpenCL device and nothing else: no network,
# no compiler, no packages, only a processor and a glibc like this one's.
#
#   tools/device_bundle.sh FOLDER [BUILD]     BUILD (build/release) was built with tests; FOLDER is made anew
#   FOLDER/run.sh [SELECTOR] [tests|bench|large]...     there: all three on device SELECTOR (gpu)
#
# What run.sh leaves is under $OUT, or FOLDER/out: a log a test, the benchmark's JSON and the figures of 10^6 and 10^7
# seeds in single and double precision.
set -eu
[ $# -ge 1 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0"; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "${2:-$root/build/release}" && pwd)
rm -rf "$1"
mkdir -p "$1/bin" "$1/lib"
folder=$(cd "$1" && pwd)

for name in cl primitives seeds neighbors pairs clip collect diagram device_diagram laws oracles verify device_rates; do
  [ -x "$build/tests/test_$name" ] || { echo "device_bundle.sh: $build/tests/test_$name is not built" >&2; exit 1; }
  cp "$build/tests/test_$name" "$folder/bin/"
done
cp "$build/apps/powercell" "$folder/bin/"
strip "$folder"/bin/*

# All shared libraries but the C library's own, which belong to the machine.
for program in "$folder"/bin/*; do ldd "$program"; done | awk '$3 ~ /^\// {print $3}' | sort -u |
  grep -Ev '/(libc|libm|libdl|librt|libpthread|ld-linux[^/]*)\.so' | while read -r library; do
  cp -L "$library" "$folder/lib/"
done

cat > "$folder/run.sh" <<'RUN'
#!/bin/sh
set -u
here=$(cd "$(dirname "$0")" && pwd)
export POWERCELL_DEVICE="${1:-gpu}" LD_LIBRARY_PATH="$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- tests bench large
out=${OUT:-$here/out}
failed=0
mkdir -p "$out"

# Where the machine names no drivers to the loader, those that it has are named here.
if [ -z "${OCL_ICD_VENDORS:-}" ] && ! ls /etc/OpenCL/vendors/*.icd >/dev/null 2>&1; then
  mkdir -p "$here/vendors"
  for driver in libnvidia-opencl.so.1 libamdocl64.so libigdrcl.so libpocl.so.2; do
    ldconfig -p | grep -q "$driver" && echo "$driver" > "$here/vendors/$driver.icd"
  done
  export OCL_ICD_VENDORS="$here/vendors"
fi

"$here/bin/powercell" devices || exit 1
for part in "$@"; do
  case $part in
    tests)
      for program in "$here"/bin/test_*; do
        name=$(basename "$program")
        if "$program" > "$out/$name.log" 2>&1; then verdict=passed; else verdict=FAILED; failed=1; fi
        echo "$name $verdict: $(grep 'test cases' "$out/$name.log" | tail -n 1)"
      done ;;
    bench) "$here/bin/powercell" bench --device "$POWERCELL_DEVICE" --json "$out/bench.json" || failed=1 ;;
    large)
      for precision in float double; do
        for n in 1000000 10000000; do
          "$here/bin/powercell" bench --device "$POWERCELL_DEVICE" --domain cube --precision "$precision" --n "$n" \
            --json "$out/cube-$precision-$n.json" || failed=1
        done
      done ;;
    *) echo "run.sh: $part is neither tests, bench nor large" >&2; exit 2 ;;
  esac
done
exit $failed
RUN
chmod +x "$folder/run.sh"
du -sh "$folder" | awk '{print "device_bundle.sh: " $1 " in " $2}'
