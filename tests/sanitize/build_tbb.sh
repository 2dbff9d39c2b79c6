#!/usr/bin/env bash
# Builds libtbb with the thread sanitizer into FOLDER, which should lie outside the source tree: the sanitizer must see how
# oneTBB hands work from thread to thread, or every hand-over looks like a race. The source is Debian's own.
#
# usage: build_tbb.sh FOLDER       needs dpkg-dev, and a line "deb-src ... bookworm main" or "Types: deb deb-src" for apt
set -euo pipefail
folder=${1:?usage: build_tbb.sh FOLDER}
mkdir -p "$folder"
cd "$folder"
compgen -G 'onetbb-*/CMakeLists.txt' >/dev/null || apt-get source onetbb
cmake -S onetbb-*/ -B build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
  -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_SANITIZE=thread >cmake.log
cmake --build build --target tbb
library=$(find "$PWD/build" -name 'libtbb.so*' -type f | head -1)
echo "built; run with: --tbb $(dirname "$library")"
