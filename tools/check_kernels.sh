#!/bin/sh
# Every .cl file must be legal OpenCL C 1.2 on its own, so that clang, editors and oclgrind can read it.
set -eu
cd "$(dirname "$0")/.."
count=0
for file in $(find kernels -name '*.cl' | sort); do
  clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Wall -Werror \
    -Wno-unused-function -target spir64 -I kernels "$file"
  count=$((count + 1))
done
echo "check_kernels: $count files are legal OpenCL C 1.2"
