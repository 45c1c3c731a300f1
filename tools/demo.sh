#!/usr/bin/env bash
# Flies the sample flight over synthetic terrain and leaves pictures, a video and a report in out/demo.
#   tools/demo.sh                 headless, through UDP between two processes
#   tools/demo.sh --window        the same in a window; needs a display
#   tools/demo.sh --new-database  makes the terrain anew, also where a whole database is there
# Asks nothing and is safe to run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly out=out/demo
readonly bin=build/release/bin
readonly flight=tools/flights/goms-c172-60s-30hz.pcap
readonly picture_rate_hz=15
readonly start_limit_s=120 # until eyepoint is ready
readonly flight_limit_s=300

window=false
new_database=false
eyepoint_pid=
port=

fail() {
    echo "tools/demo.sh: $1" >&2
    exit 1
}

read_arguments() {
    for argument in "$@"; do
        case $argument in
        --window) window=true ;;
        --new-database) new_database=true ;;
        --help | -h)
            sed -n '2,6s/^# \{0,1\}//p' tools/demo.sh
            exit 0
            ;;
        *) fail "unknown argument '$argument'; expected --window, --new-database or --help" ;;
        esac
    done
    if $window && [[ -z ${DISPLAY:-} ]]; then
        fail "--window needs a display and DISPLAY is not set; leave --window out to fly headless"
    fi
}

end_eyepoint() {
    [[ -n $eyepoint_pid ]] || return 0
    kill "$eyepoint_pid" 2>/dev/null || true
    wait "$eyepoint_pid" 2>/dev/null || true
    eyepoint_pid=
}

build() {
    tools/install_packages.sh
    cmake --preset release >"$out/build.log" || fail "configuring failed; see $out/build.log"
    cmake --build --preset release --target eyepoint eyepoint-terrain eyepoint-replay eyepoint-report
}

make_terrain() {
    if ! $new_database && "$bin/eyepoint-terrain" verify "$out/terrain" >/dev/null 2>&1; then
        echo "Terrain: $out/terrain is there and whole"
        return
    fi
    echo "Terrain: making $out/terrain"
    "$bin/eyepoint-terrain" synth -o "$out/terrain"
}

# Starts eyepoint on a free port and waits until it listens.
start_eyepoint() {
    local output=(--headless --output "$out/pictures" --rate "$picture_rate_hz" --size 1280x720)
    if $window; then output=(--window); fi
    rm -rf "$out/pictures" "$out/flight.jsonl" "$out/flight.mp4" "$out/contact-sheet.png" "$out/report.html"
    : >"$out/eyepoint.log"
    timeout --kill-after=10 $((start_limit_s + flight_limit_s)) "$bin/eyepoint" --terrain "$out/terrain" \
        --listen 127.0.0.1 --port 0 --end-after-silence 2 --record "$out/flight.jsonl" \
        --fov 50 --set view.pitch_deg=-4 \
        "${output[@]}" >"$out/eyepoint.log" 2>&1 &
    eyepoint_pid=$!
    for ((tenths = 0; tenths < start_limit_s * 10; ++tenths)); do
        port=$(sed -nE 's/.*ready: listening on [^ ]+ port ([0-9]+).*/\1/p' "$out/eyepoint.log")
        [[ -z $port ]] || return 0
        kill -0 "$eyepoint_pid" 2>/dev/null || fail "eyepoint did not start: $(tail -n 1 "$out/eyepoint.log")"
        sleep 0.1
    done
    fail "eyepoint was not ready after $start_limit_s s; see $out/eyepoint.log"
}

fly() {
    start_eyepoint
    echo "Flying $flight to UDP port $port, 60 s"
    timeout "$flight_limit_s" "$bin/eyepoint-replay" play "$flight" --to "127.0.0.1:$port" >"$out/replay.log" 2>&1 ||
        fail "eyepoint-replay failed: $(tail -n 1 "$out/replay.log")"
    local status=0
    wait "$eyepoint_pid" || status=$?
    eyepoint_pid=
    ((status == 0)) || fail "eyepoint ended with status $status: $(tail -n 1 "$out/eyepoint.log")"
    tail -n 1 "$out/eyepoint.log"
}

# The pictures as a video in which each is seen until the next one's time in the frame record, so that a frame that
# came late is late in the video too.
make_video() {
    awk -v folder=pictures -v period="$(awk "BEGIN { print 1 / $picture_rate_hz }")" '
        BEGIN { print "ffconcat version 1.0" }
        match($0, /"frame":[0-9]+/) {
            frame = substr($0, RSTART + 8, RLENGTH - 8)
            match($0, /"time_s":[-+.0-9e]+/)
            time = substr($0, RSTART + 9, RLENGTH - 9)
            if (file) printf "file %s\nduration %.6f\n", file, time - before
            file = sprintf("%s/frame-%06d.png", folder, frame)
            before = time
        }
        END { if (file) printf "file %s\nduration %.6f\n", file, period }
    ' "$out/flight.jsonl" >"$out/pictures.ffconcat"
    timeout "$flight_limit_s" ffmpeg -nostdin -loglevel error -y -f concat -i "$out/pictures.ffconcat" \
        -vf "fps=$picture_rate_hz,format=yuv420p" -c:v libx264 -preset veryfast -crf 20 -movflags +faststart "$out/flight.partial.mp4"
    mv "$out/flight.partial.mp4" "$out/flight.mp4"
    rm "$out/pictures.ffconcat"
}

make_report() {
    local pictures=(--pictures "$out/pictures")
    if $window; then
        pictures=()
    else
        make_video
        "$bin/eyepoint-report" contact-sheet "${pictures[@]}" -o "$out/contact-sheet.png" >/dev/null
    fi
    "$bin/eyepoint-report" page --record "$out/flight.jsonl" "${pictures[@]}" \
        --title "Sample flight: Cessna 172 over synthetic mountains" -o "$out/report.html" >/dev/null
}

print_results() {
    echo
    echo "The demo is in $(pwd)/$out:"
    if ! $window; then
        echo "  pictures/          $(find "$out/pictures" -name 'frame-*.png' | wc -l) numbered pictures, 1280x720"
        echo "  flight.mp4         the flight as a video"
        echo "  contact-sheet.png  twelve of the pictures on one"
    fi
    echo "  report.html        plots of the run: frame time, triangles, loads, transport delay"
    echo "  flight.jsonl       the frame record that the plots are made from"
    echo "  terrain/           the synthetic terrain database"
}

read_arguments "$@"
mkdir -p "$out"
trap end_eyepoint EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
build
make_terrain
fly
make_report
print_results
