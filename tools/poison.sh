#!/bin/sh
# Runs the tests on a copy of the library in which nothing that was not written is zero by luck: private variables of the
# kernels and buffers on the device begin with a pattern, local variables of the host with the compiler's. A result that
# depends on what was never written fails its test then, or differs from that of another pattern.
#
#   tools/poison.sh PATTERN                   all tests; a byte: 0xFF, every number NaN and every index -1; 0x3F, 0.75 and
#                                             0.00048; 0x00
#   tools/poison.sh PATTERN TEST...           some of them, for example device_diagram clip
#
# The copy is build/poison/PATTERN. Local memory of work-groups is left as it is.
set -eu
cd "$(dirname "$0")/.."
case ${1-} in 0x[0-9A-Fa-f][0-9A-Fa-f]) ;; *) set -- ;; esac
[ $# -ge 1 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
pattern=$1
shift
copy=build/poison/$pattern
mkdir -p "$copy"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

git ls-files -z | xargs -0 cp --parents -t "$work"

# A declaration without a value, alone on its line and not of a struct's member, gets POISON(name) for each name.
types='real|real2|real4|real8|mask8|index8|float|double|bool|int|uint|ulong|[a-z_0-9]+_t'
count=0
for file in $(cd "$work" && find kernels -name '*.cl'); do
  [ "$file" != kernels/base/self_test.cl ] || continue
  awk -v types="$types" '
    /typedef (struct|union)/ && !/}/ { member = 1 }
    {
      line = $0
      sub(/ *\/\*.*/, "", line)
      if (!member && !/\\$/ && line ~ "^ +(" types ") [^()=;*]+;$" && line !~ /^ +return/) {
        names = line
        sub(/^ +[A-Za-z_0-9]+ /, "", names)
        sub(/ FOR_LANES/, "", names)
        gsub(/\[[^\]]*\]|[; ]/, "", names)
        gsub(/,/, ") POISON(", names)
        print line " POISON(" names ")"
      } else print
    }
    member && /^ *}/ { member = 0 }' "$work/$file" >"$work/poisoned"
  found=$(grep -c 'POISON(' "$work/poisoned" || true)
  [ "$found" -gt 0 ] || continue
  count=$((count + found))
  {
    cat <<EOF
#ifndef POISON
#ifdef __cplusplus
#define POISON(v) __builtin_memset((void*)&v, $pattern, sizeof(v));
#else
#define POISON(v) { __private uchar* poison_at = (__private uchar*)&v; for (uint poison_k = 0; poison_k < sizeof(v); ++poison_k) poison_at[poison_k] = $pattern; }
#endif
#endif
EOF
    cat "$work/poisoned"
  } >"$work/$file"
done
rm -f "$work/poisoned"
[ "$count" -ge 50 ] || { echo "poison.sh: found only $count declarations in the kernels" >&2; exit 1; }

# A buffer, once its memory is there.
buffer=$work/lib/cl/buffer.cpp
sed -i 's/^  bytes_ = bytes;$/&\
  const unsigned char poison = '"$pattern"';\
  check(clEnqueueFillBuffer(context_->queue(), memory_, \&poison, 1, 0, bytes, 0, nullptr, nullptr), "poisoning");/' "$buffer"
[ "$(grep -c poisoning "$buffer")" = 1 ] || { echo "poison.sh: lib/cl/buffer.cpp is not as expected" >&2; exit 1; }

# What has not changed keeps its time, so that it is not compiled again.
(cd "$work" && find . -type f) | while read -r file; do
  cmp -s "$work/$file" "$copy/$file" || { mkdir -p "$copy/$(dirname "$file")" && cp "$work/$file" "$copy/$file"; }
done
(cd "$copy" && find . -path ./build -prune -o -type f -print) | while read -r file; do
  [ -e "$work/$file" ] || rm "$copy/$file"
done
rm -rf "$work"
echo "poison.sh: $count lines of declarations and every buffer begin as $pattern"

cd "$copy"
cmake --preset release -DCMAKE_CXX_FLAGS=-ftrivial-auto-var-init=pattern >/dev/null
if [ $# -eq 0 ]; then
  cmake --build --preset release --parallel "$(nproc)"
  exec ctest --preset release
fi
for test; do
  cmake --build --preset release --parallel "$(nproc)" --target "test_$test"
  "build/release/tests/test_$test"
done
