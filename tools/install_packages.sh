#!/usr/bin/env bash
# Installs every Debian 12 package that building, testing and running Eyepoint needs. As root, or with sudo.
# Asks nothing, prints little, and leaves apt alone when everything is there.
set -euo pipefail

packages=(
    # build
    ca-certificates cmake g++ git ninja-build pkg-config
    # OpenGL without a display, and windows
    libegl1 libegl-mesa0 libgl1-mesa-dri libegl-dev libepoxy-dev libglfw3-dev libglm-dev
    # the HUD, whose OpenGL functions Dear ImGui takes from libGL
    libgl1 libimgui-dev
    # the Earth
    libgdal-dev libgeographiclib-dev proj-data
    # files, pictures, video
    ffmpeg libopenimageio-dev libpcap-dev libpugixml-dev libturbojpeg0-dev libxxhash-dev libzstd-dev
    # programs
    libcli11-dev libexpected-dev libfmt-dev libspdlog-dev libtbb-dev libtomlplusplus-dev nlohmann-json3-dev
    # the report page
    libjs-chart.js
    # tests
    libgmock-dev libgtest-dev librapidcheck-dev
)

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "install_packages.sh: these packages are missing, and only root can install them: ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi

echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null
