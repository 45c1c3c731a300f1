#!/usr/bin/env bash
# Installs what is needed, builds, and runs tests; nothing asked, safe to run again.
#   tools/test.sh               every test, on the Release build
#   tools/test.sh --sanitizers  the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, a build of its own
# Tests on real data read the folder that EYEPOINT_REAL_DATA names; where it is unset they are skipped and say so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=release
targets=(all)
case ${1:-} in
'') ;;
--sanitizers)
    preset=asan
    targets=(unit-tests)
    ;;
--help | -h)
    sed -n '2,5s/^# \{0,1\}//p' tools/test.sh
    exit 0
    ;;
*)
    echo "tools/test.sh: unknown argument '$1'; expected --sanitizers or --help" >&2
    exit 2
    ;;
esac

say_how_it_ended() {
    (($1 == 0)) || echo "tools/test.sh: FAILED"
    exit "$1"
}
trap 'say_how_it_ended $?' EXIT

tools/install_packages.sh
cmake --preset $preset
cmake --build --preset $preset --target "${targets[@]}"
# Tests share the cores, but for those that fly in real time or measure time: ALONE in tests/CMakeLists.txt.
ctest --preset $preset --no-tests=error --parallel "$(nproc)"

echo "tools/test.sh: every test passed (real data: ${EYEPOINT_REAL_DATA:-not given, its tests were skipped})"
