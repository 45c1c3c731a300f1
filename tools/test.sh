#!/usr/bin/env bash
# Installs what is needed, builds, and runs every test: all of them on the Release build, then the unit tests again
# under AddressSanitizer and UndefinedBehaviorSanitizer.
# Tests on real data read the folder that EYEPOINT_REAL_DATA names; where it is unset they are skipped and say so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say_how_it_ended() {
    (($1 == 0)) || echo "tools/test.sh: FAILED"
    exit "$1"
}
trap 'say_how_it_ended $?' EXIT

tools/install_packages.sh

cmake --preset release
cmake --build --preset release
# Tests share the cores, but for those that fly in real time or measure time: ALONE in tests/CMakeLists.txt.
ctest --preset release --no-tests=error --parallel "$(nproc)"

cmake --preset asan
cmake --build --preset asan --target unit-tests
ctest --preset asan --no-tests=error --parallel "$(nproc)"

echo "tools/test.sh: every test passed (real data: ${EYEPOINT_REAL_DATA:-not given, its tests were skipped})"
